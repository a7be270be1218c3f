//! Every number of a plan against the replay.

use crate::plan::Plan;
use crate::scenario::{Objective, Scenario};

use super::broken::Findings;
use super::replay::Replay;

/// Reports each number that differs from the recomputed one.
pub(super) fn compare(scenario: &Scenario, plan: &Plan, replay: &Replay, findings: &mut Findings) {
    for (i, (stop, visit)) in plan.stops.iter().zip(&replay.visits).enumerate() {
        for (axis, claimed) in stop.position_m.iter().enumerate() {
            findings.number(
                format!("stops[{i}].position_m[{axis}]"),
                *claimed,
                visit.place.coords[axis],
            );
        }
        findings.number(format!("stops[{i}].arrive_s"), stop.arrive_s, visit.arrive_s);
        findings.number(format!("stops[{i}].depart_s"), stop.depart_s, visit.depart_s);
        findings.number(format!("stops[{i}].charge_j"), stop.charge_j, visit.charge_j);
    }
    findings.number("distance_m", plan.distance_m, replay.distance_m);
    findings.number("travel_j", plan.travel_j, replay.travel_j);
    findings.number("charge_j", plan.charge_j, replay.charge_j);
    findings.number("finish_s", plan.finish_s, replay.finish_s);
    findings.number("objective", plan.objective, objective(scenario, replay));
}

fn objective(scenario: &Scenario, replay: &Replay) -> f64 {
    match scenario.objective {
        Objective::MinDistance => replay.distance_m,
        Objective::MaxReward => {
            replay.visits.iter().map(|visit| scenario.requests[visit.request].reward).sum()
        }
        Objective::MaxCount => replay.visits.len() as f64,
    }
}
