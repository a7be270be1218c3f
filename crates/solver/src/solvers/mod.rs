//! The solvers: from a scenario to the best tour that each finds, and to the plan that shows it.
//!
//! [`solve`] is the entry. A solver counts its iterations and asks the stop rule after each; the tour
//! after N iterations does not depend on how the stop was decided.

mod acs;
mod app;
mod auto;
mod baseline;
mod budget;
mod cmst;
mod dp;
mod dqn;
mod entry;
mod enumerate;
pub mod exact;
mod greedy;
mod grow;
#[cfg(test)]
#[path = "../../tests/mixed/mod.rs"]
mod mixed;
mod mst;
mod name;
mod paper;
mod partial;
mod plan_of;
mod random;
mod shortcut;
mod tree;

pub use acs::AcsOptions;
pub use budget::Budget;
pub use entry::{
    Contender, Options, Outcome, PolicyUse, Unavailable, empty_plan, plan_from_order, solve,
    solve_compiled, solve_with,
};
pub use name::{SolverName, UnknownSolver};
pub use paper::{PaperOptions, Unfinished};
pub(crate) use partial::{Partial, gain};
