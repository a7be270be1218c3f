//! Constraints 1 to 3 of a tour: deadlines, capacity, time span.

use crate::scenario::Scenario;

use super::broken::Findings;
use super::close::{Verdict, judge, keeps};
use super::order::quoted_id;
use super::replay::Replay;

/// A bound of the charger and what a trip needs of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub(super) limit: f64,
    pub(super) needs: f64,
}

/// How a tour stands to its limits.
pub(super) struct Limits {
    /// Stop, arrival, deadline of each stop that has one.
    deadlines: Vec<(usize, f64, f64, String)>,
    pub(super) timespan: Option<Budget>,
    pub(super) capacity: Option<Budget>,
    /// The empty trip may break the two budgets where nothing better is known.
    pub(super) empty_trip: bool,
}

impl Limits {
    pub(super) fn of(scenario: &Scenario, replay: &Replay) -> Self {
        let deadline = |(i, visit): (usize, &super::replay::Visit)| {
            let deadline_s = scenario.requests[visit.request].deadline_s?;
            Some((i, visit.arrive_s, deadline_s, quoted_id(scenario, visit.request)))
        };
        let budget = |limit: Option<f64>, needs| limit.map(|limit| Budget { limit, needs });
        Self {
            deadlines: replay.visits.iter().enumerate().filter_map(deadline).collect(),
            timespan: budget(scenario.charger.timespan_s, replay.finish_s),
            capacity: budget(scenario.charger.capacity_j, replay.energy_j()),
            empty_trip: replay.visits.is_empty(),
        }
    }

    /// Reports each limit that the tour breaks.
    pub(super) fn report(&self, findings: &mut Findings) {
        for (i, arrive_s, deadline_s, id) in &self.deadlines {
            if !keeps(*arrive_s, *deadline_s) {
                let rule = format!("must be at or before the deadline of {id}, {deadline_s}");
                findings.add(format!("stops[{i}].arrive_s"), arrive_s, rule);
            }
        }
        if let Some(Budget { limit, needs }) = self.timespan.filter(Budget::is_broken) {
            let rule = format!("must be at most charger.timespan_s, {limit}");
            findings.add("finish_s", &needs, rule);
        }
        if let Some(Budget { limit, needs }) = self.capacity.filter(Budget::is_broken) {
            let rule = format!("with travel_j {needs} J: at most charger.capacity_j, {limit}");
            findings.add("charge_j", &needs, rule);
        }
    }

    /// The worst of a trip's limits of time.
    pub(super) fn in_time(&self) -> Verdict {
        let deadlines =
            self.deadlines.iter().map(|(_, arrive_s, limit, _)| judge(*arrive_s, *limit));
        let timespan = self.timespan.map(Budget::verdict);
        deadlines.chain(timespan).max().unwrap_or(Verdict::Kept)
    }

    /// Whether the capacity pays for the trip.
    pub(super) fn paid(&self) -> Verdict {
        self.capacity.map_or(Verdict::Kept, Budget::verdict)
    }
}

impl Budget {
    fn is_broken(&self) -> bool {
        !keeps(self.needs, self.limit)
    }

    pub(super) fn verdict(self) -> Verdict {
        judge(self.needs, self.limit)
    }
}
