//! The planner: from a frozen batch to a plan that holds. Knows the solver and the store's words for a
//! batch and a plan; waits for nothing and writes nothing.

mod contest;
mod part;
#[cfg(test)]
mod policy_tests;
#[cfg(test)]
mod proof_tests;
mod record;
mod scenario;
mod stored;
#[cfg(test)]
mod tests;
mod watch;

pub use contest::{Contest, PlanError, Planned, Solve, plan};
pub use part::PolicyPart;
pub use stored::{Unreadable, stored};
