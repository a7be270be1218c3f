//! Violations and warnings of coverage, each listed once, where it is, in the right numbers.

use serde_json::{Value, json};

use crate::support::{breaks, holds, judge, pushed, with, with_all, without};

/// Two disks in a row that overlap in the middle of a long field; both ask, nobody is served.
/// Sets: {}, {a}, {b}, {a, b}.
fn pair(k: u32) -> Value {
    json!({
        "format": "voltour/scenario/1", "objective": "min_distance",
        "charger": { "start_m": [0, 0], "speed_mps": 1, "travel_jpm": 1, "transfer_w": 1 },
        "coverage": { "k": k, "field_m": [[0, 0], [40, 0], [40, 20], [0, 20]] },
        "sensors": [
            { "id": "a", "position_m": [15, 10], "range_m": 8, "battery_j": 10 },
            { "id": "b", "position_m": [25, 10], "range_m": 8, "battery_j": 10 }
        ],
        "requests": [{ "sensor": "a" }, { "sensor": "b" }]
    })
}

fn nothing(unserved: Value, violations: Value, warnings: Value) -> Value {
    json!({
        "format": "voltour/plan/1", "scenario": null, "status": "best_effort", "solver": "any",
        "objective": 0, "bound": null, "distance_m": 0, "travel_j": 0, "charge_j": 0, "finish_s": 0,
        "stops": [], "unserved": unserved, "violations": violations, "warnings": warnings,
        "elapsed_s": 0
    })
}

fn short(at: [f64; 2], needs: u32, has: u32) -> Value {
    json!({ "kind": "coverage", "at_m": at, "needs": needs, "has": has })
}

fn below(at: [f64; 2], needs: u32, has: u32) -> Value {
    json!({ "kind": "below_k", "at_m": at, "needs": needs, "has": has })
}

fn both(reason: &str) -> Value {
    json!([{ "sensor": "a", "reason": reason }, { "sensor": "b", "reason": reason }])
}

fn pair_plan() -> Value {
    let violations =
        [short([10.0, 10.0], 1, 0), short([20.0, 10.0], 2, 0), short([30.0, 10.0], 1, 0)];
    let warnings = [below([1.0, 1.0], 2, 0), below([12.0, 5.0], 2, 1), below([30.0, 12.0], 2, 1)];
    nothing(both("not_chosen"), json!(violations), json!(warnings))
}

#[test]
fn all_sets_are_named() {
    holds(&pair(2), &pair_plan());
    for i in 0..3 {
        let words = "covers are needed";
        breaks(&pair(2), &without(&pair_plan(), "/violations", i), "violations", words);
        breaks(&pair(2), &without(&pair_plan(), "/warnings", i), "warnings", words);
    }
}

#[test]
fn entries_are_true() {
    let (scenario, plan) = (pair(2), pair_plan());
    let changed = |pointer: &str, value: Value| with(&plan, pointer, value);
    breaks(&scenario, &changed("/violations/1/needs", json!(1)), "violations[1].needs", "as 2");
    breaks(&scenario, &changed("/violations/1/has", json!(1)), "violations[1].has", "as 0");
    breaks(&scenario, &changed("/warnings/1/needs", json!(3)), "warnings[1].needs", "as 2");
    breaks(&scenario, &changed("/warnings/1/has", json!(0)), "warnings[1].has", "as 1");
    let names_b = changed("/violations/0/at_m", json!([29, 9]));
    breaks(&scenario, &names_b, "violations[2].at_m", "same covering");
    let bare = changed("/violations/0/at_m", json!([2, 2]));
    breaks(&scenario, &bare, "violations[0].at_m", "not short");
    let full = changed("/warnings/0/at_m", json!([20, 10]));
    breaks(&scenario, &full, "warnings[0].at_m", "not short");
    for out in [[41.0, 10.0], [-1.0, 10.0], [20.0, 20.1]] {
        let off = changed("/violations/0/at_m", json!(out));
        breaks(&scenario, &off, "violations[0].at_m", "inside coverage.field_m");
        let off = changed("/warnings/0/at_m", json!(out));
        breaks(&scenario, &off, "warnings[0].at_m", "inside coverage.field_m");
    }
}

#[test]
fn without_a_field_there_is_nothing_to_violate() {
    let mut scenario = pair(2);
    scenario["coverage"] = json!(null);
    let plan = with(&pair_plan(), "/unserved", both("not_needed"));
    breaks(&scenario, &plan, "violations[0].at_m", "inside coverage.field_m");
    breaks(&scenario, &plan, "warnings[0].at_m", "inside coverage.field_m");
    breaks(&scenario, &plan, "status", "breaks no constraint");
}

#[test]
fn members_of_a_shortfall_are_not_chosen_and_others_not_needed() {
    // k = 1: with b already charged, only a's own sub-region is short.
    let mut scenario = pair(1);
    scenario["requests"][1]["residual_j"] = json!(10);
    let plan = nothing(
        json!([{ "sensor": "a", "reason": "not_chosen" },
            { "sensor": "b", "reason": "already_charged" }]),
        json!([short([10.0, 10.0], 1, 0)]),
        json!([below([1.0, 1.0], 1, 0)]),
    );
    holds(&scenario, &plan);
    let needless = with(&plan, "/unserved/0/reason", json!("not_needed"));
    breaks(&scenario, &needless, "unserved[0].reason", "not_chosen");
    // With a silent twin of a, nothing is short.
    let twin = json!({ "id": "c", "position_m": [15, 10], "range_m": 8, "battery_j": 10 });
    let scenario = pushed(&scenario, "/sensors", twin);
    let fine = with_all(&needless, &[("/status", json!("feasible")), ("/violations", json!([]))]);
    holds(&scenario, &fine);
    let chosen = with(&fine, "/unserved/0/reason", json!("not_chosen"));
    breaks(&scenario, &chosen, "unserved[0].reason", "not_needed");
    let claimed = with(&plan, "/violations/0/at_m", json!([10, 10]));
    breaks(&scenario, &claimed, "violations[0].at_m", "not short");
}

#[test]
fn serving_mends() {
    let unserved = json!([{ "sensor": "b", "reason": "not_chosen" }]);
    let length = 2.0 * 325_f64.sqrt();
    let stop = json!([{ "sensor": "a", "position_m": [15, 10], "arrive_s": length / 2.0,
        "depart_s": length / 2.0 + 10.0, "charge_j": 10 }]);
    let plan = with_all(
        &pair_plan(),
        &[
            ("/objective", json!(length)),
            ("/distance_m", json!(length)),
            ("/travel_j", json!(length)),
            ("/charge_j", json!(10)),
            ("/finish_s", json!(length + 10.0)),
            ("/stops", stop),
            ("/unserved", unserved),
            ("/violations", json!([short([20.0, 10.0], 2, 1), short([30.0, 10.0], 1, 0)])),
        ],
    );
    holds(&pair(2), &plan);
}

/// A sliver of a face whose witness cannot be written to a millionth of a metre.
#[test]
fn witnesses_of_slivers_hold_within_the_tolerance() {
    // The disks overlap by a millionth of a millimetre: 1e-9 m.
    let mut scenario = pair(2);
    scenario["sensors"][0]["position_m"] = json!([17.0 + 0.5e-9, 10]);
    scenario["sensors"][1]["position_m"] = json!([33, 10]);
    let plan = with_all(
        &pair_plan(),
        &[
            (
                "/violations",
                json!([
                    short([10.0, 10.0], 1, 0),
                    short([30.0, 10.0], 1, 0),
                    short([25.0, 10.0], 2, 0)
                ]),
            ),
            (
                "/warnings",
                json!([
                    below([1.0, 1.0], 2, 0),
                    below([12.0, 10.0], 2, 1),
                    below([30.0, 12.0], 2, 1)
                ]),
            ),
        ],
    );
    holds(&scenario, &plan);
    breaks(&scenario, &without(&plan, "/violations", 2), "violations", "2 covers are needed, 0");
    // Just touching: no such face, and nobody asks for it.
    scenario["sensors"][0]["position_m"] = json!([17, 10]);
    holds(&scenario, &without(&plan, "/violations", 2));
}

#[test]
fn a_concave_field_counts_only_what_is_inside() {
    // A "U" of which the disks a and b fill one arm each; the gap between the arms is bare.
    let mut scenario = pair(1);
    scenario["coverage"]["field_m"] =
        json!([[0, 0], [30, 0], [30, 20], [22, 20], [22, 2], [8, 2], [8, 20], [0, 20]]);
    for (i, x) in [4, 26].iter().enumerate() {
        scenario["sensors"][i]["position_m"] = json!([x, 10]);
        scenario["sensors"][i]["range_m"] = json!(11.5);
    }
    let plan = nothing(
        both("not_chosen"),
        json!([short([1.0, 10.0], 1, 0), short([29.0, 10.0], 1, 0)]),
        json!([below([15.0, 1.0], 1, 0)]),
    );
    // Inside the overlap of the disks, at (15, 10), there is no field.
    holds(&scenario, &plan);
    let gap = pushed(&plan, "/violations", short([15.0, 10.0], 1, 0));
    breaks(&scenario, &gap, "violations[2].at_m", "inside coverage.field_m");
}

#[test]
fn findings_come_in_a_fixed_order() {
    let bad = with_all(&pair_plan(), &[("/violations", json!([])), ("/warnings", json!([]))]);
    assert_eq!(judge(&pair(2), &bad), judge(&pair(2), &bad));
    assert!(judge(&pair(2), &bad).len() >= 6);
}
