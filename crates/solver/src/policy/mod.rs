//! The policy: what a state looks like to a Q-function, and the search that a Q-function guides.

mod ahead;
mod batch;
mod encoder;
mod encoding;
mod feature;
pub mod guided;
mod knapsack;
mod pressure;
mod problem;
mod q_function;

pub use batch::Batch;
pub use encoder::Encoder;
pub use encoding::{Edges, Encoding};
pub use feature::{FEATURE_VERSION, FEATURES, Feature, IN_TOUR, REWARD};
pub use problem::{Problem, UnknownProblem};
pub use q_function::{QError, QFunction};

#[cfg(test)]
mod tests;
