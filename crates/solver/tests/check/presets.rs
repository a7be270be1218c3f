//! Right plans worked out by hand: a reward scenario with a capacity, a mobile one with a time span.

use serde_json::{Value, json};

use crate::support::holds;

/// One stop fits into the capacity, the other would too but not both; the rest never could.
pub fn reward() -> Value {
    json!({
        "format": "voltour/scenario/1", "name": "reward", "objective": "max_reward",
        "charger": { "start_m": [0, 0], "speed_mps": 5, "travel_jpm": 10, "transfer_w": 20,
                     "capacity_j": 1000 },
        "sensors": [
            { "id": "near", "position_m": [0, 10], "battery_j": 600 },
            { "id": "far", "position_m": [30, 40], "battery_j": 100 },
            { "id": "late", "position_m": [100, 0], "battery_j": 100 },
            { "id": "dear", "position_m": [0, 60], "battery_j": 100 },
            { "id": "full", "position_m": [0, 1], "battery_j": 100 },
            { "id": "silent", "position_m": [0, 2], "battery_j": 100 }
        ],
        "requests": [
            { "sensor": "near", "deadline_s": 50 },
            { "sensor": "far", "reward": 3 },
            { "sensor": "late", "deadline_s": 19.9 },
            { "sensor": "dear" },
            { "sensor": "full", "residual_j": 100 }
        ]
    })
}

pub fn reward_plan() -> Value {
    json!({
        "format": "voltour/plan/1", "scenario": "reward", "status": "feasible", "solver": "greedy",
        "objective": 600, "bound": 603,
        "distance_m": 20, "travel_j": 200, "charge_j": 600, "finish_s": 34,
        "stops": [{ "sensor": "near", "position_m": [0, 10], "arrive_s": 2, "depart_s": 32,
                    "charge_j": 600 }],
        "unserved": [
            { "sensor": "far", "reason": "no_capacity" },
            { "sensor": "late", "reason": "unreachable" },
            { "sensor": "dear", "reason": "no_capacity" },
            { "sensor": "full", "reason": "already_charged" }
        ],
        "violations": [], "warnings": [], "elapsed_s": 0
    })
}

/// The same with a capacity that pays for the far one, too, if it comes alone.
pub fn reward_rich() -> Value {
    crate::support::with(&reward(), "/charger/capacity_j", json!(1100))
}

pub fn reward_rich_plan() -> Value {
    crate::support::with(&reward_plan(), "/unserved/0/reason", json!("not_chosen"))
}

/// A sensor that flees, met after ten seconds at (50, 0), and one that is met on the way back.
pub fn mobile() -> Value {
    json!({
        "format": "voltour/scenario/1", "objective": "max_count",
        "charger": { "start_m": [0, 0], "end_m": [50, 30], "speed_mps": 5, "travel_jpm": 0,
                     "transfer_w": 40, "timespan_s": 100 },
        "charge_level": 0.81,
        "sensors": [
            { "id": "m1", "trajectory": [[0, 20, 0], [100, 320, 0]], "battery_j": 1000 },
            { "id": "m2", "position_m": [50, 15], "battery_j": 1000 },
            { "id": "m3", "trajectory": [[-5, 900, 900]], "battery_j": 1000 }
        ],
        "requests": [
            { "sensor": "m1", "residual_j": 10 },
            { "sensor": "m2", "residual_j": 410, "ready_s": 40 },
            { "sensor": "m3" }
        ]
    })
}

pub fn mobile_plan() -> Value {
    json!({
        "format": "voltour/plan/1", "scenario": null, "status": "optimal", "solver": "exact",
        "objective": 2, "bound": 2,
        "distance_m": 80, "travel_j": 0, "charge_j": 1200, "finish_s": 53,
        "stops": [
            { "sensor": "m1", "position_m": [50, 0], "arrive_s": 10, "depart_s": 30, "charge_j": 800 },
            { "sensor": "m2", "position_m": [50, 15], "arrive_s": 40, "depart_s": 50, "charge_j": 400 }
        ],
        "unserved": [{ "sensor": "m3", "reason": "unreachable" }],
        "violations": [], "warnings": [], "elapsed_s": 1e-3
    })
}

/// Distances by a matrix that is neither symmetric nor Euclidean.
pub fn matrix() -> Value {
    json!({
        "format": "voltour/scenario/1", "objective": "min_distance",
        "charger": { "start_m": [0, 0], "speed_mps": 2, "travel_jpm": 1, "transfer_w": 10 },
        "sensors": [
            { "id": "a", "position_m": [3, 4], "battery_j": 100 },
            { "id": "b", "position_m": [6, 8], "battery_j": 100 }
        ],
        "requests": [
            { "sensor": "a", "required": true, "drain_w": 1, "residual_j": 50 },
            { "sensor": "b", "required": true }
        ],
        "travel": { "distance_m": [
            [9, 7, 2, 4],
            [9, 9, 9, 9],
            [9, 16, 9, 6],
            [9, 32, 10, 9]
        ] }
    })
}

pub fn matrix_plan() -> Value {
    json!({
        "format": "voltour/plan/1", "scenario": null, "status": "feasible", "solver": "any",
        "objective": 30, "bound": null,
        "distance_m": 30, "travel_j": 30, "charge_j": 167, "finish_s": 31.7,
        "stops": [
            { "sensor": "b", "position_m": [6, 8], "arrive_s": 2, "depart_s": 12, "charge_j": 100 },
            { "sensor": "a", "position_m": [3, 4], "arrive_s": 17, "depart_s": 23.7, "charge_j": 67 }
        ],
        "unserved": [], "violations": [], "warnings": [], "elapsed_s": 0
    })
}

#[test]
fn right_plans_hold() {
    holds(&reward(), &reward_plan());
    holds(&reward_rich(), &reward_rich_plan());
    holds(&mobile(), &mobile_plan());
    holds(&matrix(), &matrix_plan());
}
