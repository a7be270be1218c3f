//! A compiled instance as a document: all that the model needs, so that Python does no geometry.

use std::error::Error;

use serde::Serialize;
use voltour_solver::instance::{self, Instance};
use voltour_solver::scenario::{Objective, Scenario};
use voltour_solver::solvers::{Options, SolverName, solve};
use voltour_solver::stop::MaxIterations;
use voltour_solver::tolerance::tolerance;

/// Places are indices: candidates 0 to n - 1, then start (n) and end (n + 1). No limit is null.
#[derive(Serialize)]
pub struct Compiled {
    name: String,
    objective: &'static str,
    speed_mps: f64,
    transfer_w: f64,
    travel_jpm: f64,
    capacity_j: Option<f64>,
    timespan_s: Option<f64>,
    candidates: Vec<Candidate>,
    /// Row to column.
    distance_m: Vec<Vec<f64>>,
    demands: Vec<Demand>,
    /// Whether leaving a stop out never breaks a limit and never lengthens the tour.
    metric: bool,
    /// The greedy tour, from which CP-SAT may begin.
    hint: Vec<usize>,
}

#[derive(Serialize)]
struct Candidate {
    /// Index of the request in the scenario.
    request: usize,
    ready_s: f64,
    due_s: Option<f64>,
    /// Energy that a charge at time 0 delivers.
    charge_j: f64,
    /// What each second of waiting adds to that.
    drain_w: f64,
    reward: f64,
}

#[derive(Serialize)]
struct Demand {
    needs: u32,
    members: Vec<u32>,
}

impl Compiled {
    /// The document of a scenario, or why the model cannot express it.
    pub fn new(name: &str, scenario: &Scenario) -> Result<Self, Box<dyn Error>> {
        let instance = Instance::new(scenario);
        if let Some(reason) = beyond(&instance) {
            return Err(format!("{name}: {reason}").into());
        }
        let candidates: Vec<Candidate> = (instance.candidates.iter())
            .map(|candidate| Candidate {
                request: candidate.request,
                ready_s: candidate.ready_s,
                due_s: finite(candidate.due_s),
                charge_j: candidate.charge_j(0.0),
                drain_w: candidate.drain_w,
                reward: candidate.reward,
            })
            .collect();
        let places = 0..instance.len() + 2;
        let row = |from| places.clone().map(|to| instance.distance_m(from, to)).collect();
        let demands = instance.demands.demands.iter();
        Ok(Self {
            name: name.to_owned(),
            objective: scenario.objective.name(),
            speed_mps: scenario.charger.speed_mps,
            transfer_w: scenario.charger.transfer_w,
            travel_jpm: scenario.charger.travel_jpm,
            capacity_j: finite(instance.capacity_j),
            timespan_s: finite(instance.timespan_s),
            distance_m: places.clone().map(row).collect(),
            demands: demands
                .map(|demand| Demand { needs: demand.needs, members: demand.members.clone() })
                .collect(),
            metric: instance.metric,
            hint: greedy(scenario, &candidates)?,
            candidates,
        })
    }
}

/// What the model does not know. Each would need more than linear constraints on whole numbers, and
/// none of the scenarios has it.
fn beyond(instance: &Instance<'_>) -> Option<&'static str> {
    if instance.moving {
        return Some("a sensor moves");
    }
    // A deadline is often the moment at which the sensor runs empty, rounded: nothing changes there.
    let empties = |c: &instance::Candidate| {
        c.due_s.min(instance.timespan_s) > c.empty_s() + 2.0 * tolerance(c.empty_s())
    };
    if instance.candidates.iter().any(empties) {
        return Some("a sensor may run empty before it is charged");
    }
    let drains = instance.candidates.iter().any(|candidate| candidate.drain_w > 0.0);
    if drains && instance.capacity_j.is_finite() {
        return Some("the energy that the capacity bounds grows with time");
    }
    (instance.scenario.objective == Objective::MaxCount).then_some("its objective is max_count")
}

fn finite(limit: f64) -> Option<f64> {
    limit.is_finite().then_some(limit)
}

/// The greedy tour as candidates.
fn greedy(scenario: &Scenario, candidates: &[Candidate]) -> Result<Vec<usize>, Box<dyn Error>> {
    let stop = MaxIterations(u64::MAX);
    let options = Options { solver: SolverName::Greedy, seed: 0, stop: &stop, policy: None };
    let plan = solve(scenario, &options)?.plan;
    let candidate_of = |id: &str| {
        candidates
            .iter()
            .position(|c| scenario.sensors[scenario.requests[c.request].sensor].id == id)
    };
    Ok(plan.stops.iter().filter_map(|stop| candidate_of(&stop.sensor)).collect())
}
