//! [`Lever`]: the number of the scenario that changes, and how much of it a given tour needs.

use super::super::change::{Buys, Change, NextChange};
use super::super::facts::Trip;
use crate::check::check;
use crate::coverage::Demand;
use crate::instance::Instance;
use crate::plan::Plan;
use crate::scenario::{Objective, Place, Scenario, Sensor};
use crate::solvers::plan_from_order;
use crate::tour::simulate;

/// A number that may be raised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Lever {
    Capacity,
    Timespan,
    Speed,
    /// Of a request.
    Deadline(usize),
}

/// A charger this much faster stands for one that needs no time on its way.
const FAST: f64 = 1e4;

impl Lever {
    /// The number now; `None` if it is free already.
    pub(in super::super) fn now(self, scenario: &Scenario) -> Option<f64> {
        match self {
            Self::Capacity => scenario.charger.capacity_j,
            Self::Timespan => scenario.charger.timespan_s,
            Self::Speed => Some(scenario.charger.speed_mps),
            Self::Deadline(request) => scenario.requests[request].deadline_s,
        }
    }

    /// The scenario with another number.
    pub(super) fn set(self, scenario: &Scenario, value: f64) -> Scenario {
        let mut changed = scenario.clone();
        match self {
            Self::Capacity => changed.charger.capacity_j = Some(value),
            Self::Timespan => changed.charger.timespan_s = Some(value),
            Self::Speed => changed.charger.speed_mps = value,
            Self::Deadline(request) => changed.requests[request].deadline_s = Some(value),
        }
        changed
    }

    /// The scenario in which the number is no obstacle.
    pub(super) fn free(self, scenario: &Scenario) -> Scenario {
        let mut changed = scenario.clone();
        match self {
            Self::Capacity => changed.charger.capacity_j = None,
            Self::Timespan => changed.charger.timespan_s = None,
            Self::Speed => changed.charger.speed_mps *= FAST,
            Self::Deadline(request) => changed.requests[request].deadline_s = None,
        }
        changed
    }

    /// How much a tour, given by requests, needs in the scenario in which the number is free; `None` where
    /// that is no more than it has.
    pub(super) fn need(self, scenario: &Scenario, order: &[usize]) -> Option<f64> {
        let now = self.now(scenario)?;
        let need = match self {
            Self::Speed => speed_for(scenario, order)?,
            _ => {
                let free = self.free(scenario);
                let instance = bare(&free);
                let stops = candidates(&instance, order);
                match self {
                    Self::Capacity => Trip::of(&instance, &stops).energy_j,
                    Self::Timespan => Trip::of(&instance, &stops).finish_s,
                    _ => arrival(&instance, &stops, self)?,
                }
            }
        };
        (need > now).then_some(need)
    }

    /// Whether more of it is never worse. A faster charger meets a moving sensor elsewhere, and may spend more
    /// energy for it.
    pub(super) fn is_monotone(self, scenario: &Scenario) -> bool {
        let moves = |s: &Sensor| matches!(s.place, Place::Moving(_));
        let dear = scenario.charger.capacity_j.is_some();
        self != Self::Speed || !dear || !scenario.sensors.iter().any(moves)
    }

    pub(super) fn change(self, scenario: &Scenario, to: f64) -> Option<Change> {
        let from = self.now(scenario)?;
        Some(match self {
            Self::Capacity => Change::Capacity { from_j: from, to_j: to },
            Self::Timespan => Change::Timespan { from_s: from, to_s: to },
            Self::Speed => Change::Speed { from_mps: from, to_mps: to },
            Self::Deadline(request) => {
                let sensor = scenario.sensors[scenario.requests[request].sensor].id.clone();
                Change::Deadline { sensor, from_s: from, to_s: to }
            }
        })
    }

    /// The suggestion, if the plan of this tour passes the check of the scenario that is changed so.
    pub(super) fn suggest(
        self,
        scenario: &Scenario,
        to: f64,
        order: &[usize],
        buys: impl FnOnce(&Plan) -> Option<Buys>,
    ) -> Option<NextChange> {
        let changed = self.set(scenario, to);
        let plan = plan_from_order(&changed, order, "explain");
        if !plan.status.is_feasible() || !check(&changed, &plan).is_empty() {
            return None;
        }
        Some(NextChange {
            change: self.change(scenario, to)?,
            buys: buys(&plan)?,
            tour: plan.stops.iter().map(|stop| stop.sensor.clone()).collect(),
            too_little: None,
            proven: false,
        })
    }
}

fn arrival(instance: &Instance<'_>, stops: &[u32], lever: Lever) -> Option<f64> {
    let Lever::Deadline(request) = lever else { return None };
    let mut run = instance.departure();
    for &stop in stops {
        run = instance.step(&run, stop);
        if instance.candidates[stop as usize].request == request {
            return Some(run.arrive_s);
        }
    }
    None
}

/// The least speed at which a tour keeps its limits, by bisection over simulations.
fn speed_for(scenario: &Scenario, order: &[usize]) -> Option<f64> {
    let legal = |speed_mps: f64| {
        let changed = Lever::Speed.set(scenario, speed_mps);
        let instance = bare(&changed);
        let stops = candidates(&instance, order);
        // As a solver keeps its limits, so that the check has the rest of the tolerance.
        simulate(&instance, &stops).1
    };
    let (mut slow, mut fast) = (scenario.charger.speed_mps, scenario.charger.speed_mps * FAST);
    if !legal(fast) {
        return None;
    }
    while fast > slow * (1.0 + 1e-4) {
        let middle = (slow * fast).sqrt();
        if legal(middle) { fast = middle } else { slow = middle }
    }
    Some(fast)
}

/// The instance with one demand that names every request: for simulation alone, without the dear arrangement of
/// the disks.
fn bare(scenario: &Scenario) -> Instance<'_> {
    let all = Demand {
        members: (0..scenario.requests.len() as u32).collect(),
        needs: 1,
        witness: scenario.charger.start_m,
    };
    Instance::with_demands(scenario, &[all])
}

/// The candidates that stand for these requests.
fn candidates(instance: &Instance<'_>, order: &[usize]) -> Vec<u32> {
    let candidate = |&request: &usize| {
        instance.candidates.binary_search_by_key(&request, |c| c.request).ok().map(|c| c as u32)
    };
    order.iter().filter_map(candidate).collect()
}

/// The value of a plan's tour, larger is better.
pub(super) fn gain(scenario: &Scenario, plan: &Plan) -> f64 {
    match scenario.objective {
        Objective::MinDistance => -plan.distance_m,
        Objective::MaxReward | Objective::MaxCount => plan.objective,
    }
}
