//! What an operator may set of the scheduler.

use std::time::Duration;

use voltour_solver::solvers::SolverName;

/// Of the scheduler and its planner.
#[derive(Clone, Debug)]
pub struct Settings {
    /// From the close of a batch to second 0 at the earliest; longer than `budget`.
    pub lead: Duration,
    /// Time that the search for a tour may take.
    pub budget: Duration,
    /// A departure that would start later than this after its t0 is missed.
    pub max_late: Duration,
    /// A tour of which nothing was heard for so long after its planned finish is overdue.
    pub overdue_after: Duration,
    /// Which solver plans.
    pub solver: SolverName,
    /// Seed of every search.
    pub seed: u64,
    /// Departures of different networks that are planned at once.
    pub planner_threads: usize,
    /// How much there may be.
    pub limits: Limits,
}

/// How much there may be of what is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Networks.
    pub networks: u32,
    /// Departures of a network that wait for their plan.
    pub departures: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { networks: 1_000, departures: 1_000 }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            lead: Duration::from_secs(3),
            budget: Duration::from_secs(2),
            max_late: Duration::from_secs(600),
            overdue_after: Duration::from_secs(30 * 60),
            solver: SolverName::Auto,
            seed: 0,
            planner_threads: 2,
            limits: Limits::default(),
        }
    }
}
