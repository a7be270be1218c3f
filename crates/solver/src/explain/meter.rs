//! The stop rule shared out: every decision and every simulated tour is counted on one meter.

use std::cell::Cell;

use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::exact::{self, Verdict};
use crate::stop::StopRule;

/// Counts iterations over all questions of an explanation.
pub(super) struct Meter<'a> {
    stop: &'a dyn StopRule,
    iterations: u64,
    cut: bool,
}

impl<'a> Meter<'a> {
    pub(super) fn new(stop: &'a dyn StopRule) -> Self {
        Self { stop, iterations: 0, cut: false }
    }

    pub(super) fn iterations(&self) -> u64 {
        self.iterations
    }

    /// Whether some question was given up.
    pub(super) fn is_cut(&self) -> bool {
        self.cut
    }

    /// A question is given up.
    pub(super) fn cut(&mut self) {
        self.cut = true;
    }

    /// Counts one iteration of an own loop; whether it may go on.
    pub(super) fn spend(&mut self) -> bool {
        let goes_on = !self.stop.should_stop(self.iterations);
        if goes_on {
            self.iterations += 1;
        } else {
            self.cut = true;
        }
        goes_on
    }

    /// Gives a search at most so many iterations, and counts those after which it asked whether to stop.
    pub(super) fn lend<T>(&mut self, most: u64, search: impl FnOnce(&dyn StopRule) -> T) -> T {
        let before = self.iterations;
        let took = Cell::new(0);
        let stop = |done: u64| {
            took.set(done.max(took.get()));
            done >= most || self.stop.should_stop(before + done)
        };
        let found = search(&stop);
        self.iterations += took.get();
        found
    }

    /// Decides an instance within so many iterations.
    pub(super) fn decide(&mut self, instance: &Instance<'_>, most: u64) -> Verdict {
        // A question costs something even where its answer is plain.
        if !self.spend() {
            return Verdict::Unknown;
        }
        self.lend(most, |stop| exact::decide(instance, &mut Budget::new(stop)))
    }
}
