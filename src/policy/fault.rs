//! Why a model is not used: what was found, and what is required.

use voltour_solver::policy::FEATURE_VERSION;

/// A model that is not used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {fault}")]
pub struct ModelError {
    /// Its path, or that it is part of the binary.
    pub file: String,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// It is not there.
    #[error("there is no model")]
    Missing,
    /// The system does not give it out, or not whole.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is no ONNX, or one that does not run.
    #[error("is no ONNX model that runs: {0}")]
    Damaged(String),
    /// It takes the features of another version.
    #[error(
        "takes features of version {found} (voltour.feature_version); this voltour computes version {FEATURE_VERSION}"
    )]
    WrongVersion {
        /// What its metadata say.
        found: String,
    },
    /// It is trained for another problem.
    #[error("is trained for {found} (voltour.problem); {required} is required")]
    WrongProblem {
        /// What its metadata say.
        found: String,
        /// The problem that it is to plan, or the words for any of them.
        required: String,
    },
    /// An input or output is not what the contract says.
    #[error("{tensor} is {found}; {required} is required")]
    WrongShape {
        /// Its name.
        tensor: &'static str,
        /// Its type and sizes.
        found: String,
        /// What they must be.
        required: String,
    },
    /// It yields NaN or an infinity.
    #[error("yields {0} for a state that it is probed with; every value must be finite")]
    NotFinite(String),
}
