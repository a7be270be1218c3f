//! What a visit that is not yet made would look like: the facts behind an insertion.

use super::{Run, Tour};
use crate::instance::Instance;

/// A candidate put at a position of a tour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit {
    /// Metres by which the way grows.
    pub detour_m: f64,
    /// Seconds from leaving the place before it to the beginning of its charge.
    pub leg_s: f64,
    /// Seconds that its own deadline, and the rest of the tour, would still have; infinite without limits.
    pub slack_s: f64,
    /// Seconds by which what comes behind it begins later.
    pub delay_s: f64,
}

impl Tour {
    /// The charger after the last stop. Where the instance is untimed, only the place means anything.
    pub(crate) fn last(&self, instance: &Instance<'_>) -> Run {
        if let Some(run) = self.after_last() {
            return *run;
        }
        let departure = instance.departure();
        match self.order().last() {
            Some(&node) => {
                Run { node, place: instance.candidates[node as usize].point, ..departure }
            }
            None => departure,
        }
    }

    /// The least that a stop could be late, or the end, without breaking a limit, in seconds; infinite
    /// without limits.
    pub(crate) fn least_slack_s(&self, instance: &Instance<'_>) -> f64 {
        let end = instance.timespan_s - self.finished().arrive_s;
        if instance.untimed {
            return end;
        }
        let slack = |p: usize| {
            let due = instance.candidates[self.order()[p] as usize].due_s;
            due - self.arrive_s(p)
        };
        (0..self.len()).map(slack).fold(end, f64::min)
    }

    /// The visit of a candidate put before `position`.
    pub(crate) fn visit(&self, instance: &Instance<'_>, position: usize, candidate: u32) -> Visit {
        if instance.untimed {
            let detour_m = self.detour_m(instance, position, candidate);
            let charge_j = instance.candidates[candidate as usize].charge_j(0.0);
            let delay_s = detour_m * instance.travel_spm + charge_j * instance.transfer_spj;
            let from = self.place_before(instance, position);
            return Visit {
                detour_m,
                leg_s: instance.distance_m(from, candidate as usize) * instance.travel_spm,
                slack_s: instance.timespan_s - self.finished().arrive_s - delay_s,
                delay_s,
            };
        }
        let before = self.before(position);
        let run = instance.step(before, candidate);
        let own_s = instance.candidates[candidate as usize].due_s - run.arrive_s;
        let leg_s = run.arrive_s - before.depart_s;
        if instance.moving {
            let end = self.resume(instance, &run, position);
            let end = end.unwrap_or_else(|| instance.finish(&run));
            return Visit {
                detour_m: end.distance_m - self.finished().distance_m,
                leg_s,
                slack_s: own_s.min(instance.timespan_s - end.arrive_s),
                delay_s: end.arrive_s - self.finished().arrive_s,
            };
        }
        let next = self.place(instance, position);
        let leg_m = instance.distance_m(candidate as usize, next);
        let reach_s = run.depart_s + leg_m * instance.travel_spm;
        Visit {
            detour_m: self.detour_m(instance, position, candidate),
            leg_s,
            slack_s: own_s.min(self.latest(position) - reach_s),
            delay_s: reach_s - self.arrive_s(position),
        }
    }
}
