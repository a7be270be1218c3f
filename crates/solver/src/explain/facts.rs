//! What a tour takes and what it breaks, by simulation, as `check` judges it: the whole tolerance counts.

use super::explanation::{Alone, Breach};
use crate::instance::Instance;
use crate::tolerance::holds;
use crate::tour::Run;

/// A stop that would be late.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Late {
    pub candidate: u32,
    pub arrive_s: f64,
    pub deadline_s: f64,
}

/// A whole trip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Trip {
    pub distance_m: f64,
    pub finish_s: f64,
    pub energy_j: f64,
    /// Number of late stops, and the first of them.
    pub late: usize,
    pub first_late: Option<Late>,
    /// By how much all limits together are broken, each as a share of itself.
    pub excess: f64,
}

impl Trip {
    /// The trip that goes on from `run` with these stops.
    pub(super) fn from(
        instance: &Instance<'_>,
        mut run: Run,
        stops: impl Iterator<Item = u32>,
    ) -> Self {
        let (mut late, mut first_late, mut excess) = (0, None, 0.0);
        for candidate in stops {
            run = instance.step(&run, candidate);
            if let Some(found) = late_at(instance, &run) {
                late += 1;
                first_late = first_late.or(Some(found));
                excess += share(found.arrive_s, found.deadline_s);
            }
        }
        let end = instance.finish(&run);
        let (finish_s, energy_j) = (end.arrive_s, instance.energy_j(&end));
        let charger = &instance.scenario.charger;
        for (value, limit) in [(finish_s, charger.timespan_s), (energy_j, charger.capacity_j)] {
            if let Some(limit) = limit.filter(|&limit| !holds(value, limit)) {
                excess += share(value, limit);
            }
        }
        Self { distance_m: end.distance_m, finish_s, energy_j, late, first_late, excess }
    }

    /// The trip with these stops.
    pub(super) fn of(instance: &Instance<'_>, order: &[u32]) -> Self {
        Self::from(instance, instance.departure(), order.iter().copied())
    }

    /// Whether the capacity does not pay for it.
    pub(super) fn over_capacity(&self, instance: &Instance<'_>) -> bool {
        instance.scenario.charger.capacity_j.is_some_and(|limit| !holds(self.energy_j, limit))
    }

    /// Whether it ends too late.
    pub(super) fn over_timespan(&self, instance: &Instance<'_>) -> bool {
        instance.scenario.charger.timespan_s.is_some_and(|limit| !holds(self.finish_s, limit))
    }

    /// Whether constraints 1 to 3 hold.
    pub(super) fn is_legal(&self, instance: &Instance<'_>) -> bool {
        self.late == 0 && !self.over_capacity(instance) && !self.over_timespan(instance)
    }
}

fn share(value: f64, limit: f64) -> f64 {
    (value - limit) / limit.max(1.0)
}

fn late_at(instance: &Instance<'_>, run: &Run) -> Option<Late> {
    let request = &instance.scenario.requests[instance.candidates[run.node as usize].request];
    let deadline_s = request.deadline_s.filter(|&deadline_s| !holds(run.arrive_s, deadline_s))?;
    Some(Late { candidate: run.node, arrive_s: run.arrive_s, deadline_s })
}

/// Every limit that a trip with these stops breaks.
pub(super) fn breaches(instance: &Instance<'_>, order: &[u32]) -> Vec<Breach> {
    let mut run = instance.departure();
    let mut breaches = Vec::new();
    for &candidate in order {
        run = instance.step(&run, candidate);
        if let Some(Late { arrive_s, deadline_s, .. }) = late_at(instance, &run) {
            let sensor = sensor_id(instance, candidate);
            breaches.push(Breach::Deadline { sensor, arrive_s, deadline_s });
        }
    }
    let trip = Trip::of(instance, order);
    let charger = &instance.scenario.charger;
    if let Some(timespan_s) = charger.timespan_s.filter(|_| trip.over_timespan(instance)) {
        breaches.push(Breach::Timespan { finish_s: trip.finish_s, timespan_s });
    }
    if let Some(capacity_j) = charger.capacity_j.filter(|_| trip.over_capacity(instance)) {
        breaches.push(Breach::Capacity { energy_j: trip.energy_j, capacity_j });
    }
    breaches
}

/// What a candidate takes as the only stop.
pub(super) fn alone(instance: &Instance<'_>, candidate: u32) -> Alone {
    let run = instance.step(&instance.departure(), candidate);
    let end = instance.finish(&run);
    Alone {
        sensor: sensor_id(instance, candidate),
        arrive_s: run.arrive_s,
        deadline_s: request_of(instance, candidate).deadline_s,
        finish_s: end.arrive_s,
        energy_j: instance.energy_j(&end),
    }
}

fn request_of<'a>(instance: &Instance<'a>, candidate: u32) -> &'a crate::scenario::Request {
    &instance.scenario.requests[instance.candidates[candidate as usize].request]
}

/// The id of a candidate's sensor.
pub(super) fn sensor_id(instance: &Instance<'_>, candidate: u32) -> String {
    instance.scenario.sensors[request_of(instance, candidate).sensor].id.clone()
}

/// The charger before each position of a tour, the end's included.
pub(super) fn runs(instance: &Instance<'_>, order: &[u32]) -> Vec<Run> {
    let mut runs = vec![instance.departure()];
    for (i, &candidate) in order.iter().enumerate() {
        runs.push(instance.step(&runs[i], candidate));
    }
    runs
}
