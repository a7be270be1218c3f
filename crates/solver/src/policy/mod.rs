//! The policy: what a state looks like to a Q-function, and the search that a Q-function guides.

mod batch;
mod feature;
mod problem;
mod q_function;

pub use batch::Batch;
pub use feature::{FEATURE_VERSION, FEATURES, IN_TOUR, REWARD};
pub use problem::{Problem, UnknownProblem};
pub use q_function::{QError, QFunction};
