//! [`Sample`]: what was learnt of a state.

use std::sync::Arc;

use voltour_solver::policy::Encoding;

/// What is known of some actions of a state: rewards, and the state after them if more follows.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The state.
    pub state: Arc<Encoding>,
    /// Rows, and the sum of the rewards from that action on.
    pub labels: Vec<(u32, f32)>,
    /// The state whose best value is to be added; `None` where the rewards are those to the end.
    pub bootstrap: Option<Arc<Encoding>>,
}
