//! From an order of candidates to the plan document: every field, the reasons, the violations.

use crate::instance::Instance;
use crate::plan::{FORMAT, Plan, Reason, Status, Stop, Unserved, Violation, Warning};
use crate::scenario::Objective;
use crate::tolerance::holds;
use crate::tour::{Run, Tour, simulate};

/// The plan of a tour. Its status is `feasible` if the tour keeps every constraint, else `best_effort`.
pub fn plan_of(instance: &Instance<'_>, order: &[u32], solver: &str) -> Plan {
    let scenario = instance.scenario;
    let tour = Tour::new(instance, order);
    let (runs, legal) = simulate(instance, order);
    let end = runs.last().copied().unwrap_or_else(|| instance.departure());
    let violations = violations(instance, &tour, &end);
    // An empty trip that only the whole tolerance allows is feasible all the same: there is no other.
    let feasible = (legal || order.is_empty()) && violations.is_empty();
    let objective = match scenario.objective {
        Objective::MinDistance => end.distance_m,
        Objective::MaxReward => tour.reward(instance),
        Objective::MaxCount => order.len() as f64,
    };
    Plan {
        format: FORMAT.to_owned(),
        scenario: scenario.name.clone(),
        status: if feasible { Status::Feasible } else { Status::BestEffort },
        solver: solver.to_owned(),
        objective,
        bound: None,
        distance_m: end.distance_m,
        travel_j: scenario.charger.travel_jpm * end.distance_m,
        charge_j: end.charge_j,
        finish_s: end.arrive_s,
        stops: runs[..order.len()].iter().map(|run| stop(instance, run)).collect(),
        unserved: unserved(instance, &tour),
        violations,
        warnings: warnings(instance),
        elapsed_s: 0.0,
    }
}

fn sensor_id<'a>(instance: &Instance<'a>, request: usize) -> &'a str {
    &instance.scenario.sensors[instance.scenario.requests[request].sensor].id
}

fn stop(instance: &Instance<'_>, run: &Run) -> Stop {
    let candidate = &instance.candidates[run.node as usize];
    Stop {
        sensor: sensor_id(instance, candidate.request).to_owned(),
        position_m: [run.place.x, run.place.y],
        arrive_s: run.arrive_s,
        depart_s: run.depart_s,
        charge_j: candidate.charge_j(run.arrive_s),
    }
}

fn unserved(instance: &Instance<'_>, tour: &Tour) -> Vec<Unserved> {
    let mut candidate_of = vec![None; instance.scenario.requests.len()];
    for (i, candidate) in (0u32..).zip(&instance.candidates) {
        candidate_of[candidate.request] = Some(i);
    }
    let mends = mends(instance, tour);
    let reason = |candidate: Option<u32>| match candidate {
        None => Some(Reason::AlreadyCharged),
        Some(c) if tour.serves(c) => None,
        Some(c) => Some(reason(instance, c, mends[c as usize])),
    };
    let requests = candidate_of.into_iter().enumerate();
    requests
        .filter_map(|(request, candidate)| {
            let sensor = || sensor_id(instance, request).to_owned();
            reason(candidate).map(|reason| Unserved { sensor: sensor(), reason })
        })
        .collect()
}

/// Why a candidate is not a stop. These are facts about the scenario: the whole tolerance counts.
fn reason(instance: &Instance<'_>, candidate: u32, mends: bool) -> Reason {
    let charger = &instance.scenario.charger;
    let request = &instance.scenario.requests[instance.candidates[candidate as usize].request];
    let run = instance.step(&instance.departure(), candidate);
    let end = instance.finish(&run);
    let keeps = |value: f64, limit: Option<f64>| limit.is_none_or(|limit| holds(value, limit));
    if !keeps(run.arrive_s, request.deadline_s) || !keeps(end.arrive_s, charger.timespan_s) {
        Reason::Unreachable
    } else if !keeps(instance.energy_j(&end), charger.capacity_j) {
        Reason::NoCapacity
    } else if instance.scenario.objective == Objective::MinDistance && !mends {
        Reason::NotNeeded
    } else {
        Reason::NotChosen
    }
}

/// By candidate, whether serving it would mend a shortfall.
fn mends(instance: &Instance<'_>, tour: &Tour) -> Vec<bool> {
    let mut mends = vec![false; instance.len()];
    for demand in &instance.all_demands.demands {
        let has = demand.members.iter().filter(|&&member| tour.serves(member)).count();
        if has < demand.needs as usize {
            for &member in &demand.members {
                mends[member as usize] = true;
            }
        }
    }
    mends
}

fn violations(instance: &Instance<'_>, tour: &Tour, end: &Run) -> Vec<Violation> {
    let scenario = instance.scenario;
    let mut violations = Vec::new();
    if tour.is_empty() {
        let charger = &scenario.charger;
        let energy_j = instance.energy_j(end);
        if let Some(limit) = charger.timespan_s.filter(|&limit| !holds(end.arrive_s, limit)) {
            violations.push(Violation::Timespan { limit, needs: end.arrive_s });
        }
        if let Some(limit) = charger.capacity_j.filter(|&limit| !holds(energy_j, limit)) {
            violations.push(Violation::Capacity { limit, needs: energy_j });
        }
    }
    let mut lost = vec![false; scenario.sensors.len()];
    for (i, candidate) in (0u32..).zip(&instance.candidates) {
        if !tour.serves(i) {
            lost[scenario.requests[candidate.request].sensor] = true;
            if candidate.required {
                let sensor = sensor_id(instance, candidate.request).to_owned();
                violations.push(Violation::Required { sensor });
            }
        }
    }
    let k = scenario.coverage.as_ref().map_or(0, |coverage| coverage.k as usize);
    for region in &instance.regions {
        let has = region.covering.iter().filter(|&&sensor| !lost[sensor as usize]).count();
        let needs = k.min(region.covering.len());
        if has < needs {
            let at_m = [region.witness.x, region.witness.y];
            violations.push(Violation::Coverage { at_m, needs: needs as u32, has: has as u32 });
        }
    }
    violations
}

fn warnings(instance: &Instance<'_>) -> Vec<Warning> {
    let k = instance.scenario.coverage.as_ref().map_or(0, |coverage| coverage.k);
    let thin = instance.regions.iter().filter(|region| region.covering.len() < k as usize);
    thin.map(|region| Warning::BelowK {
        at_m: [region.witness.x, region.witness.y],
        needs: k,
        has: region.covering.len() as u32,
    })
    .collect()
}
