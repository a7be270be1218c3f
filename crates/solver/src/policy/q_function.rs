//! [`QFunction`]: what a trained policy is to the solver.

use super::Batch;

/// The values of all actions in some states (paper, section 5.3): one row of `q` a state.
///
/// The solver neither knows nor asks how they come about: a network in training, an ONNX model, a rule.
pub trait QFunction: Send + Sync {
    /// `q [B, N]`, row by row: for each state, the value of inserting each candidate. What stands in rows of
    /// padding, or of candidates that are no legal action, means nothing.
    ///
    /// # Errors
    /// The function cannot answer. A caller treats values that are not finite in the same way.
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError>;

    /// Whether it reads the features of the step ahead, the dearest; they are 0 for one that does not.
    fn reads_ahead(&self) -> bool {
        true
    }

    /// Whether it may be asked further. It is asked before each state is encoded, which takes longer than its values
    /// where there are many candidates; one that may not answers [`QError::TooSlow`].
    fn has_time(&self) -> bool {
        true
    }
}

/// A Q-function cannot answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QError {
    /// It broke down.
    #[error("the Q-function failed: {0}")]
    Failed(String),
    /// A value is NaN or infinite.
    #[error("the Q-function returned {0}, which is not finite")]
    NotFinite(String),
    /// The answer has the wrong number of values.
    #[error("the Q-function returned {found} values, but {expected} were asked for")]
    WrongSize {
        /// B x N.
        expected: usize,
        /// What came.
        found: usize,
    },
    /// It took more than its share of the time.
    #[error("the Q-function took more than its share of the time")]
    TooSlow,
}
