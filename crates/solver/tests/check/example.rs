//! The scenario and the plan of the format's own page.

use serde_json::{Value, json};

use crate::support::{breaks, holds, with, with_all};

pub fn scenario() -> Value {
    json!({
        "format": "voltour/scenario/1",
        "name": "small",
        "objective": "min_distance",
        "charger": {
            "start_m": [250, 250], "end_m": [250, 250],
            "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20,
            "capacity_j": null, "timespan_s": null
        },
        "charge_level": 1.0,
        "coverage": { "k": 1, "field_m": [[0,0],[300,0],[300,300],[0,300]] },
        "sensors": [
            { "id": "s1", "position_m": [150, 150], "range_m": 250, "battery_j": 10800 }
        ],
        "requests": [
            { "sensor": "s1", "ready_s": 0, "deadline_s": 5400, "residual_j": 1620,
              "drain_w": 0.3, "reward": 9180, "required": false }
        ]
    })
}

pub fn plan() -> Value {
    json!({
        "format": "voltour/plan/1",
        "scenario": "small",
        "status": "optimal",
        "solver": "exact",
        "objective": 282.842712, "bound": 282.842712,
        "distance_m": 282.842712, "travel_j": 169705.627485,
        "charge_j": 9188.485281, "finish_s": 515.992807,
        "stops": [
            { "sensor": "s1", "position_m": [150, 150], "arrive_s": 28.284271,
              "depart_s": 487.708535, "charge_j": 9188.485281 }
        ],
        "unserved": [], "violations": [], "warnings": [],
        "elapsed_s": 0.0004
    })
}

#[test]
fn example_holds() {
    holds(&scenario(), &plan());
}

/// The charger stays at home: the whole field is bare, and the plan says so.
pub fn stay_home() -> Value {
    with_all(
        &plan(),
        &[
            ("/status", json!("best_effort")),
            ("/objective", json!(0)),
            ("/bound", json!(null)),
            ("/distance_m", json!(0)),
            ("/travel_j", json!(0)),
            ("/charge_j", json!(0)),
            ("/finish_s", json!(0)),
            ("/stops", json!([])),
            ("/unserved", json!([{ "sensor": "s1", "reason": "not_chosen" }])),
            (
                "/violations",
                json!([{ "kind": "coverage", "at_m": [150, 150], "needs": 1, "has": 0 }]),
            ),
        ],
    )
}

#[test]
fn an_honest_failure_holds() {
    holds(&scenario(), &stay_home());
    holds(&scenario(), &with(&stay_home(), "/status", json!("infeasible")));
}

#[test]
fn a_failure_is_not_called_a_success() {
    let lie = with(&stay_home(), "/status", json!("feasible"));
    breaks(&scenario(), &lie, "status", "breaks a constraint");
    breaks(&scenario(), &lie, "violations", "must be empty");
    let silent = with(&lie, "/violations", json!([]));
    breaks(&scenario(), &silent, "violations", "1 covers are needed, 0 there");
    breaks(&scenario(), &silent, "status", "breaks a constraint");
}

#[test]
fn a_success_is_not_called_a_failure() {
    for status in ["best_effort", "infeasible"] {
        let shy = with_all(&plan(), &[("/status", json!(status)), ("/bound", json!(null))]);
        breaks(&scenario(), &shy, "status", "breaks no constraint");
        breaks(&scenario(), &shy, "violations", "must name what is broken");
    }
}
