//! The solvers: from a scenario to the best tour that each finds, and to the plan that shows it.
//!
//! [`solve`] is the entry. A solver counts its iterations and asks the stop rule after each; the tour
//! after N iterations does not depend on how the stop was decided.

mod auto;
mod baseline;
mod budget;
mod dqn;
mod entry;
mod enumerate;
pub mod exact;
mod greedy;
mod grow;
mod name;
mod partial;
mod plan_of;
mod random;
mod shortcut;

pub use budget::Budget;
pub use entry::{
    Contender, Options, Outcome, PolicyUse, Unavailable, empty_plan, plan_from_order, solve,
    solve_compiled,
};
pub use name::{SolverName, UnknownSolver};
pub(crate) use partial::{Partial, gain};
