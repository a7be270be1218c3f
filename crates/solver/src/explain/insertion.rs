//! Every place in the present tour for a candidate that is not served.

use super::facts::{Trip, runs};
use super::meter::Meter;
use crate::instance::Instance;
use crate::tour::Run;

/// So many steps are simulated for all insertions together; beyond them the explanation says that it is not
/// complete.
const STEPS: u64 = 30_000_000;

/// A candidate put before a position, and the trip that this makes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Insertion {
    pub candidate: u32,
    pub position: usize,
    pub trip: Trip,
}

/// The present tour, ready for insertions.
pub(super) struct Present<'a, 'b> {
    pub instance: &'a Instance<'b>,
    pub order: Vec<u32>,
    pub trip: Trip,
    runs: Vec<Run>,
    steps: u64,
}

impl<'a, 'b> Present<'a, 'b> {
    pub(super) fn new(instance: &'a Instance<'b>, order: Vec<u32>) -> Self {
        Self {
            trip: Trip::of(instance, &order),
            runs: runs(instance, &order),
            instance,
            order,
            steps: 0,
        }
    }

    /// Every insertion of a candidate, by position; `None` where the meter or the steps have run out.
    pub(super) fn insertions(
        &mut self,
        candidate: u32,
        meter: &mut Meter<'_>,
    ) -> Option<Vec<Insertion>> {
        self.steps += (self.order.len() as u64 + 2).pow(2) / 2;
        if self.steps > STEPS {
            meter.cut();
            return None;
        }
        if !meter.spend() {
            return None;
        }
        let at = |position: usize| Insertion {
            candidate,
            position,
            trip: self.trip_with(candidate, position),
        };
        Some((0..=self.order.len()).map(at).collect())
    }

    /// No stop before the position is late: the plan's tour keeps its deadlines.
    fn trip_with(&self, candidate: u32, position: usize) -> Trip {
        let rest = self.order[position..].iter().copied();
        Trip::from(self.instance, self.runs[position], std::iter::once(candidate).chain(rest))
    }

    /// The tour with an insertion.
    pub(super) fn with(&self, insertion: &Insertion) -> Vec<u32> {
        let mut order = self.order.clone();
        order.insert(insertion.position, insertion.candidate);
        order
    }
}

/// The insertion that breaks nothing and has the least way, else the one that breaks least.
pub(super) fn cheapest<'i>(
    instance: &Instance<'_>,
    insertions: &'i [Insertion],
) -> Option<&'i Insertion> {
    let rank = |i: &Insertion| {
        let legal = i.trip.is_legal(instance);
        (!legal, if legal { 0.0 } else { i.trip.excess }, i.trip.distance_m)
    };
    insertions.iter().min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    })
}
