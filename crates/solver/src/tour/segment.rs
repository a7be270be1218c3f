//! A run of stops as a constant-size record that concatenates (`design.md`, "Segments concatenate";
//! the idea is Kindervater and Savelsbergh's, 1997, here with charges that grow with the arrival).

use super::Run;
use crate::instance::Instance;

/// A run of stops. `a` is the time at which the charger gets to the first of them, before any wait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// First place.
    pub first: u32,
    /// Last place.
    pub last: u32,
    /// One leaves the last place at `max(floor, offset + slope a)`.
    pub floor: f64,
    /// See `floor`.
    pub offset: f64,
    /// See `floor`; >= 1.
    pub slope: f64,
    /// Every deadline of the run holds if and only if `a <= latest_s`.
    pub latest_s: f64,
    /// Length inside the run, in metres.
    pub distance_m: f64,
    /// Energy delivered is `charge + charge_slope a`, in joules (no drain, or no ready time).
    pub charge: f64,
    /// See `charge`.
    pub charge_slope: f64,
}

impl Segment {
    /// One candidate.
    #[inline]
    pub fn stop(instance: &Instance<'_>, node: u32) -> Self {
        let candidate = &instance.candidates[node as usize];
        let charge = candidate.target_j - candidate.residual_j;
        let slope = 1.0 + candidate.drain_w * instance.transfer_spj;
        let offset = charge * instance.transfer_spj;
        Self {
            first: node,
            last: node,
            floor: candidate.ready_s * slope + offset,
            offset,
            slope,
            latest_s: candidate.due_s,
            distance_m: 0.0,
            charge,
            charge_slope: candidate.drain_w,
        }
    }

    /// The end of the tour.
    pub fn end(instance: &Instance<'_>) -> Self {
        Self {
            first: instance.end() as u32,
            last: instance.end() as u32,
            floor: f64::NEG_INFINITY,
            offset: 0.0,
            slope: 1.0,
            latest_s: instance.timespan_s,
            distance_m: 0.0,
            charge: 0.0,
            charge_slope: 0.0,
        }
    }

    /// This run, then `next`.
    #[inline]
    pub fn then(&self, instance: &Instance<'_>, next: &Self) -> Self {
        let leg_m = instance.distance_m(self.last as usize, next.first as usize);
        let leg_s = leg_m * instance.travel_spm;
        let reached = self.offset + leg_s;
        let latest_s = if self.floor + leg_s > next.latest_s {
            f64::NEG_INFINITY
        } else {
            self.latest_s.min((next.latest_s - reached) / self.slope)
        };
        Self {
            first: self.first,
            last: next.last,
            floor: next.floor.max(next.offset + next.slope * (self.floor + leg_s)),
            offset: next.offset + next.slope * reached,
            slope: self.slope * next.slope,
            latest_s,
            distance_m: self.distance_m + leg_m + next.distance_m,
            charge: self.charge + next.charge + next.charge_slope * reached,
            charge_slope: self.charge_slope + next.charge_slope * self.slope,
        }
    }

    /// The charger after the run, if it comes from `run` and every deadline holds.
    pub fn after(&self, instance: &Instance<'_>, run: &Run) -> Option<Run> {
        let leg_m = instance.distance_m(run.node as usize, self.first as usize);
        let reach_s = run.depart_s + leg_m * instance.travel_spm;
        let depart_s = self.floor.max(self.offset + self.slope * reach_s);
        (reach_s <= self.latest_s).then_some(Run {
            node: self.last,
            place: run.place,
            arrive_s: depart_s,
            depart_s,
            distance_m: run.distance_m + leg_m + self.distance_m,
            charge_j: run.charge_j + self.charge + self.charge_slope * reach_s,
        })
    }
}
