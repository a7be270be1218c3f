//! How good a tour is, lexicographically; smaller is better.

use std::cmp::Ordering;

use super::Tour;
use crate::instance::Instance;
use crate::scenario::Objective;

/// Relative difference below which two objectives count as equal: rounding, nothing more.
const EQUAL: f64 = 1e-9;

/// The value of a legal tour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Unserved `required` requests.
    pub missing_required: u32,
    /// Missing covers, summed over the distinct covering sets.
    pub missing_covers: u64,
    /// The objective, negated where it is maximised.
    pub cost: f64,
    /// The tie-break: length in metres, or finish in seconds.
    pub tie: f64,
}

impl Value {
    /// The value of a tour.
    pub fn of(instance: &Instance<'_>, tour: &Tour) -> Self {
        let missing = instance.all_demands.missing(|candidate| tour.serves(candidate));
        Self::with_missing(instance, tour, missing)
    }

    /// The value of a tour of which is known what it misses.
    pub fn with_missing(instance: &Instance<'_>, tour: &Tour, missing: (u32, u64)) -> Self {
        let (missing_required, missing_covers) = missing;
        let end = tour.finished();
        let (cost, tie) = match instance.scenario.objective {
            Objective::MinDistance => (end.distance_m, end.arrive_s),
            Objective::MaxReward => (-tour.reward(instance), end.distance_m),
            Objective::MaxCount => (-(tour.len() as f64), end.arrive_s),
        };
        Self { missing_required, missing_covers, cost, tie }
    }

    /// Whether constraints 4 and 5 hold.
    pub fn is_feasible(&self) -> bool {
        self.missing_required == 0 && self.missing_covers == 0
    }

    /// Compares two values; `Less` is better.
    pub fn compare(&self, other: &Self) -> Ordering {
        let close = |a: f64, b: f64| {
            if (a - b).abs() <= EQUAL * a.abs().max(b.abs()) {
                Ordering::Equal
            } else {
                a.total_cmp(&b)
            }
        };
        self.missing_required
            .cmp(&other.missing_required)
            .then(self.missing_covers.cmp(&other.missing_covers))
            .then_with(|| close(self.cost, other.cost))
            .then_with(|| close(self.tie, other.tie))
    }

    /// Whether this value is better than the other.
    pub fn beats(&self, other: &Self) -> bool {
        self.compare(other) == Ordering::Less
    }
}
