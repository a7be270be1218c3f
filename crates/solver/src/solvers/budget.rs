//! The iterations that a search has done and may still do.

use std::cell::RefCell;

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
        if self.stopped {
            return false;
        }
        self.iterations += 1;
        self.lasts()
    }

    /// Asks the rule once more without counting an iteration; whether the search may go on. For steps that take long,
    /// which end where they are.
    pub fn lasts(&mut self) -> bool {
        self.stopped = self.stopped || self.stop.should_stop(self.iterations);
        !self.stopped
    }

    /// Forgets the iterations after the first so many, of a search whose outcome is thrown away. Where the rule
    /// has said stop, that stands.
    pub fn take_back(&mut self, to: u64) {
        self.iterations = self.iterations.min(to);
    }

    /// Runs a search on a part of this budget: at most `most` iterations, counted here too. The rule is
    /// heeded only after the first `least`, which the search is always given.
    pub fn part<T>(
        &mut self,
        least: u64,
        most: u64,
        search: impl FnOnce(&mut Budget<'_>) -> T,
    ) -> T {
        let whole = RefCell::new(self);
        let stop = |done: u64| {
            let goes_on = done == 0 || whole.borrow_mut().spend();
            done >= most || !goes_on && done >= least
        };
        search(&mut Budget::new(&stop))
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
