//! From a tour that holds to what is stored: the plan with its provenance, the scenario, the stops as
//! requests of the batch at absolute times.

use std::collections::HashMap;
use std::time::Duration;

use jiff::Timestamp;
use serde::Serialize;
use voltour_solver::plan::{Plan, Stop};
use voltour_solver::scenario::{Document, FORMAT, Scenario};

use super::contest::{Contest, PlanError, Winner};
use super::part::PolicyPart;
use crate::clock::plus;
use crate::domain::{Contender, PhaseIterations, Provenance, Request, Versions};
use crate::store::{Batch, NewPlan, NewStop, pack};

/// What is stored: the documents of the format, with where they came from beside them.
#[derive(Serialize)]
struct Envelope<'a> {
    plan: &'a Plan,
    provenance: &'a Provenance,
}

pub(super) fn record(
    batch: &Batch,
    contest: &Contest,
    document: &Document,
    scenario: &Scenario,
    winner: Winner,
    policy: &PolicyPart,
) -> Result<NewPlan, PlanError> {
    let provenance = provenance(batch, contest, &winner, policy);
    let plan = winner.outcome.plan;
    let packed = |json: Result<Vec<u8>, serde_json::Error>| {
        let json = json.map_err(|error| PlanError::Record(error.to_string()))?;
        pack(&json).map_err(|error| PlanError::Record(error.to_string()))
    };
    let envelope = packed(serde_json::to_vec(&Envelope { plan: &plan, provenance: &provenance }))?;
    let by_sensor: HashMap<&str, &Request> =
        batch.requests.iter().map(|request| (request.asked.sensor_id.as_str(), request)).collect();
    let stops = plan.stops.iter().map(|stop| new_stop(batch, &by_sensor, stop));
    let charger = &scenario.charger;
    Ok(NewPlan {
        status: plan.status,
        solver: plan.solver.clone(),
        objective: plan.objective,
        bound: plan.bound,
        distance_m: plan.distance_m,
        travel_j: plan.travel_j,
        charge_j: plan.charge_j,
        start_m: charger.start_m.into(),
        end_m: charger.end_m.into(),
        finish: after(batch.start, plan.finish_s),
        stops: stops.collect::<Result<_, _>>()?,
        unserved: u32::try_from(plan.unserved.len()).unwrap_or(u32::MAX),
        envelope,
        scenario: packed(serde_json::to_vec(document))?,
    })
}

fn new_stop(
    batch: &Batch,
    by_sensor: &HashMap<&str, &Request>,
    stop: &Stop,
) -> Result<NewStop, PlanError> {
    let request = by_sensor.get(stop.sensor.as_str());
    let missing = || PlanError::Record(format!("{:?} has no request in the batch", stop.sensor));
    let request = request.ok_or_else(missing)?;
    Ok(NewStop {
        request_id: request.id,
        sensor_id: request.asked.sensor_id.clone(),
        position_m: stop.position_m,
        arrive: after(batch.start, stop.arrive_s),
        depart: after(batch.start, stop.depart_s),
        charge_j: stop.charge_j,
    })
}

fn provenance(
    batch: &Batch,
    contest: &Contest,
    winner: &Winner,
    policy: &PolicyPart,
) -> Provenance {
    let Winner { outcome, refused, .. } = winner;
    let contender = |contender: &voltour_solver::solvers::Contender| Contender {
        solver: contender.solver.clone(),
        objective: contender.objective,
        status: contender.status.name().to_owned(),
        elapsed_s: winner.time_of(&contender.solver),
        iterations: contender.iterations,
    };
    let phase = |(phase, iterations): &(String, u64)| PhaseIterations {
        phase: phase.clone(),
        iterations: *iterations,
    };
    Provenance {
        asked: contest.solver.name().to_owned(),
        contenders: outcome.contenders.iter().map(contender).collect(),
        winner: outcome.plan.solver.clone(),
        gap: outcome.plan.gap(),
        policy: policy.used.clone(),
        fallback_reason: policy.reason(refused),
        seed: contest.seed,
        iterations: outcome.iterations.iter().map(|(_, iterations)| iterations).sum(),
        phases: outcome.iterations.iter().map(phase).collect(),
        versions: Versions {
            voltour: env!("CARGO_PKG_VERSION").to_owned(),
            scenario_format: FORMAT.to_owned(),
            network: batch.network.version,
        },
        start: batch.start,
        batch: batch.requests.iter().map(|request| request.id).collect(),
        check: match refused.as_slice() {
            [] => vec!["holds".to_owned()],
            refused => refused.to_vec(),
        },
    }
}

/// A time `after_s` seconds after the start; a plan may not be finite where nothing can be reached.
fn after(start: Timestamp, after_s: f64) -> Timestamp {
    plus(start, Duration::try_from_secs_f64(after_s.max(0.0)).unwrap_or(Duration::MAX))
}
