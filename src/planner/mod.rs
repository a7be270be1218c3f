//! The planner: from a frozen batch to a plan that holds. Knows the solver and the store's words for a
//! batch and a plan; waits for nothing and writes nothing.

mod contest;
#[cfg(test)]
mod proof_tests;
mod record;
mod scenario;
mod stored;
#[cfg(test)]
mod tests;

pub use contest::{Contest, PlanError, Solve, plan};
pub use stored::{Unreadable, stored};
