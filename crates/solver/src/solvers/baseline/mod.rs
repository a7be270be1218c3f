//! The baseline: construction, then ruin and recreate under simulated annealing, for any scenario.
//!
//! The tour it works on always keeps constraints 1 to 3; what it lacks of 4 and 5 is penalised. No
//! schedule depends on when the clock will stop the search: annealing runs double in length, and the
//! search ends by itself when nothing has improved for long.

mod cost;
mod recreate;
mod ruin;
mod search;

pub(super) use search::{construction, search, whole_runs};
pub use search::{finish, solve};

#[cfg(test)]
mod tests;
