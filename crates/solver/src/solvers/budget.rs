//! The iterations that a search has done and may still do.

use super::SolverName;
use crate::stop::StopRule;

/// Counts iterations over all phases of a solve and asks the stop rule once after each.
pub struct Budget<'a> {
    stop: &'a dyn StopRule,
    iterations: u64,
    stopped: bool,
}

impl<'a> Budget<'a> {
    /// A budget of which nothing is spent; asks the rule once.
    pub fn new(stop: &'a dyn StopRule) -> Self {
        Self { stop, iterations: 0, stopped: stop.should_stop(0) }
    }

    /// Counts one iteration; whether the search may go on.
    pub fn spend(&mut self) -> bool {
        if !self.stopped {
            self.iterations += 1;
            self.stopped = self.stop.should_stop(self.iterations);
        }
        !self.stopped
    }

    /// Tells the rule's host that a solver is done with its part.
    pub fn done(&self, solver: SolverName) {
        self.stop.done(solver.name());
    }

    /// Whether the rule has said stop.
    pub fn is_spent(&self) -> bool {
        self.stopped
    }

    /// Iterations so far.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }
}
