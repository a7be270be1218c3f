//! A right plan, one field changed at a time: each change is found, and found where it is.

use serde_json::{Value, json};

use crate::example;
use crate::presets::{
    matrix, matrix_plan, mobile, mobile_plan, reward, reward_plan, reward_rich, reward_rich_plan,
};
use crate::support::{breaks, holds, pushed, with, with_all, without};

/// Every number of a plan that is recomputed, as a JSON pointer and as the path reported.
fn numbers(plan: &Value) -> Vec<(String, String)> {
    let plain = ["objective", "distance_m", "travel_j", "charge_j", "finish_s"];
    let mut numbers: Vec<_> = plain.iter().map(|n| (format!("/{n}"), (*n).to_owned())).collect();
    let stops = plan["stops"].as_array().expect("a list");
    for i in 0..stops.len() {
        for name in ["arrive_s", "depart_s", "charge_j"] {
            numbers.push((format!("/stops/{i}/{name}"), format!("stops[{i}].{name}")));
        }
        for axis in 0..2 {
            let path = format!("stops[{i}].position_m[{axis}]");
            numbers.push((format!("/stops/{i}/position_m/{axis}"), path));
        }
    }
    numbers
}

#[test]
fn every_number_is_recomputed_within_the_tolerance() {
    let cases = [
        (example::scenario(), example::plan()),
        (reward(), with(&reward_plan(), "/bound", json!(null))),
        (mobile(), mobile_plan()),
        (matrix(), matrix_plan()),
    ];
    for (scenario, plan) in cases {
        for (pointer, path) in numbers(&plan) {
            let right = plan.pointer(&pointer).unwrap().as_f64().unwrap();
            let tolerance = 1e-6_f64.max(1e-6 * right.abs());
            for sign in [-1.0, 1.0] {
                let off = with(&plan, &pointer, json!(right + sign * 3.0 * tolerance));
                breaks(&scenario, &off, &path, "recomputed as");
                let near = with(&plan, &pointer, json!(right + sign * 0.4 * tolerance));
                holds(&scenario, &near);
            }
        }
    }
}

#[test]
fn header() {
    let (scenario, plan) = (example::scenario(), example::plan());
    breaks(&scenario, &with(&plan, "/scenario", json!("big")), "scenario", "\"small\"");
    breaks(&scenario, &with(&plan, "/scenario", json!(null)), "scenario", "\"small\"");
    breaks(&mobile(), &with(&mobile_plan(), "/scenario", json!("x")), "scenario", "null");
    breaks(&scenario, &with(&plan, "/elapsed_s", json!(-0.1)), "elapsed_s", ">= 0");
    let typed = voltour_solver::scenario::Scenario::from_json(scenario.to_string().as_bytes());
    let mut made = voltour_solver::plan::Plan::from_json(plan.to_string().as_bytes()).unwrap();
    made.format = "voltour/plan/2".into();
    made.distance_m = f64::NAN;
    let broken = voltour_solver::check::check(&typed.unwrap(), &made);
    let paths: Vec<_> = broken.iter().map(|b| b.path.as_str()).collect();
    assert_eq!(paths, ["format", "distance_m"]);
}

#[test]
fn stops_are_candidates_once() {
    let (scenario, plan) = (reward(), reward_plan());
    let stop = |id: &str| with(&plan, "/stops/0/sensor", json!(id));
    breaks(&scenario, &stop("nobody"), "stops[0].sensor", "no sensor");
    breaks(&scenario, &stop("a\nb"), "stops[0].sensor", "no sensor");
    breaks(&scenario, &stop("silent"), "stops[0].sensor", "no request");
    breaks(&scenario, &stop("full"), "stops[0].sensor", "already charged");
    let twice = pushed(&plan, "/stops", plan["stops"][0].clone());
    breaks(&scenario, &twice, "stops[1].sensor", "at most once");
}

#[test]
fn deadlines_are_kept_in_every_status() {
    let at = |deadline: f64| with(&example::scenario(), "/requests/0/deadline_s", json!(deadline));
    let late = at(28.28);
    breaks(&late, &example::plan(), "stops[0].arrive_s", "deadline of \"s1\", 28.28");
    let shy =
        with_all(&example::plan(), &[("/status", json!("best_effort")), ("/bound", json!(null))]);
    breaks(&late, &shy, "stops[0].arrive_s", "deadline of \"s1\"");
    // The arrival is 28.2842712...: the deadline holds up to the tolerance and no further.
    holds(&at(28.284_271_2 - 2.7e-5), &example::plan());
    breaks(&at(28.284_271_2 - 3.0e-5), &example::plan(), "stops[0].arrive_s", "deadline");
}

#[test]
fn budgets_are_kept() {
    let poor = with(&reward(), "/charger/capacity_j", json!(799));
    breaks(&poor, &reward_plan(), "charge_j", "charger.capacity_j, 799");
    let short = with(&mobile(), "/charger/timespan_s", json!(52));
    breaks(&short, &mobile_plan(), "finish_s", "charger.timespan_s, 52");
}

#[test]
fn an_empty_trip_may_break_budgets_if_it_says_so() {
    let scenario = with_all(
        &mobile(),
        &[("/charger/timespan_s", json!(10)), ("/charger/travel_jpm", json!(1))],
    );
    let mut scenario = scenario;
    scenario["charger"]["capacity_j"] = json!(50);
    let length = 3400_f64.sqrt();
    let unserved = ["m1", "m2", "m3"].map(|id| json!({ "sensor": id, "reason": "unreachable" }));
    let plan = with_all(
        &mobile_plan(),
        &[
            ("/status", json!("infeasible")),
            ("/objective", json!(0)),
            ("/bound", json!(null)),
            ("/distance_m", json!(length)),
            ("/travel_j", json!(length)),
            ("/charge_j", json!(0)),
            ("/finish_s", json!(length / 5.0)),
            ("/stops", json!([])),
            ("/unserved", json!(unserved)),
            (
                "/violations",
                json!([
                    { "kind": "timespan", "limit": 10, "needs": length / 5.0 },
                    { "kind": "capacity", "limit": 50, "needs": length },
                ]),
            ),
        ],
    );
    holds(&scenario, &plan);
    breaks(&scenario, &with(&plan, "/status", json!("feasible")), "finish_s", "timespan_s");
    breaks(&scenario, &without(&plan, "/violations", 0), "violations", "breaks the timespan");
    breaks(&scenario, &without(&plan, "/violations", 1), "violations", "breaks the capacity");
    for (entry, field) in [(0, "limit"), (0, "needs"), (1, "limit"), (1, "needs")] {
        let off = with(&plan, &format!("/violations/{entry}/{field}"), json!(1));
        breaks(&scenario, &off, &format!("violations[{entry}].{field}"), "recomputed as");
    }
    let twice = pushed(&plan, "/violations", plan["violations"][0].clone());
    breaks(&scenario, &twice, "violations[2]", "once");
}

#[test]
fn budgets_are_violations_of_empty_trips_only() {
    let entry = json!({ "kind": "capacity", "limit": 1000, "needs": 800 });
    let plan = pushed(&reward_plan(), "/violations", entry);
    breaks(&reward(), &plan, "violations[0]", "only for an empty trip");
    breaks(&reward(), &plan, "violations", "must be empty");
}

#[test]
fn unserved_lists_each_request_once_with_its_reason() {
    let (scenario, plan) = (reward(), reward_plan());
    let wrong = ["already_charged", "unreachable", "no_capacity", "not_needed", "not_chosen"];
    for (i, right) in plan["unserved"].as_array().unwrap().iter().enumerate() {
        for reason in wrong.iter().filter(|reason| right["reason"] != **reason) {
            let changed = with(&plan, &format!("/unserved/{i}/reason"), json!(reason));
            let path = format!("unserved[{i}].reason");
            breaks(&scenario, &changed, &path, right["reason"].as_str().unwrap());
        }
        breaks(&scenario, &without(&plan, "/unserved", i), "unserved", "must be listed");
        let twice = pushed(&plan, "/unserved", right.clone());
        breaks(&scenario, &twice, "unserved[4].sensor", "once");
    }
    let entry = |id: &str| json!({ "sensor": id, "reason": "not_chosen" });
    let more = |id: &str| pushed(&plan, "/unserved", entry(id));
    breaks(&scenario, &more("near"), "unserved[4].sensor", "is a stop");
    breaks(&scenario, &more("silent"), "unserved[4].sensor", "no request");
    breaks(&scenario, &more("nobody"), "unserved[4].sensor", "no sensor");
    let poor = with(&reward_rich_plan(), "/unserved/0/reason", json!("no_capacity"));
    breaks(&reward_rich(), &poor, "unserved[0].reason", "not_chosen");
}

#[test]
fn reasons_are_open_where_rounding_decides() {
    // "far" alone takes 100 m at 10 J/m and 100 J: 1100 J.
    let at = |capacity: f64| with(&reward(), "/charger/capacity_j", json!(capacity));
    let (poor, rich) = (reward_plan(), reward_rich_plan());
    holds(&at(1100.0), &rich);
    breaks(&at(1100.0), &poor, "unserved[0].reason", "not_chosen");
    holds(&at(1100.0 - 1e-3), &poor);
    holds(&at(1100.0 - 1e-3), &rich);
    breaks(&at(1100.0 - 3e-3), &rich, "unserved[0].reason", "no_capacity");
}

#[test]
fn a_ready_time_can_make_a_request_unreachable() {
    let mut scenario = reward();
    scenario["charger"]["timespan_s"] = json!(60);
    scenario["requests"][1]["ready_s"] = json!(46);
    // Alone: charged from 46 to 51 s, home at 61 s.
    let plan = with(&reward_plan(), "/unserved/0/reason", json!("unreachable"));
    holds(&scenario, &plan);
}

#[test]
fn required_requests_are_served_or_named() {
    let mut scenario = reward();
    scenario["requests"][2]["required"] = json!(true);
    // A requirement on a sensor that is full already is kept.
    scenario["requests"][4]["required"] = json!(true);
    let silent = reward_plan();
    breaks(&scenario, &silent, "violations", "\"late\"");
    breaks(&scenario, &silent, "status", "breaks a constraint");
    let entry = |id: &str| json!({ "kind": "required", "sensor": id });
    let honest = with_all(&silent, &[("/status", json!("infeasible")), ("/bound", json!(null))]);
    let honest = pushed(&honest, "/violations", entry("late"));
    holds(&scenario, &honest);
    for id in ["late", "near", "full", "nobody"] {
        let more = pushed(&honest, "/violations", entry(id));
        breaks(&scenario, &more, "violations[1].sensor", "required request");
    }
}

#[test]
fn needless_requests_are_named_so_under_min_distance_only() {
    let mut scenario = matrix();
    scenario["requests"][1]["required"] = json!(false);
    let plan = with_all(
        &matrix_plan(),
        &[
            ("/objective", json!(18)),
            ("/distance_m", json!(18)),
            ("/travel_j", json!(18)),
            ("/charge_j", json!(51)),
            ("/finish_s", json!(14.1)),
            (
                "/stops",
                json!([{ "sensor": "a", "position_m": [3, 4], "arrive_s": 1,
                "depart_s": 6.1, "charge_j": 51 }]),
            ),
            ("/unserved", json!([{ "sensor": "b", "reason": "not_needed" }])),
        ],
    );
    holds(&scenario, &plan);
    let chosen = with(&plan, "/unserved/0/reason", json!("not_chosen"));
    breaks(&scenario, &chosen, "unserved[0].reason", "not_needed");
    // A required one that is left out is not chosen.
    let honest = with_all(
        &chosen,
        &[
            ("/status", json!("best_effort")),
            ("/violations", json!([{ "kind": "required", "sensor": "b" }])),
        ],
    );
    holds(&matrix(), &honest);
    let needless = with(&honest, "/unserved/0/reason", json!("not_needed"));
    breaks(&matrix(), &needless, "unserved[0].reason", "not_chosen");
}

#[test]
fn an_empty_trip_by_matrix_counts_its_own_distance() {
    let mut scenario = matrix();
    for request in 0..2 {
        scenario["requests"][request]["required"] = json!(false);
    }
    let plan = with_all(
        &matrix_plan(),
        &[
            ("/objective", json!(7)),
            ("/distance_m", json!(7)),
            ("/travel_j", json!(7)),
            ("/charge_j", json!(0)),
            ("/finish_s", json!(3.5)),
            ("/stops", json!([])),
            (
                "/unserved",
                json!([{ "sensor": "b", "reason": "not_needed" },
                { "sensor": "a", "reason": "not_needed" }]),
            ),
        ],
    );
    holds(&scenario, &plan);
    breaks(&scenario, &with(&plan, "/distance_m", json!(0)), "distance_m", "recomputed as 7");
}

#[test]
fn bounds_never_contradict_the_tour() {
    let (scenario, plan) = (example::scenario(), example::plan());
    let feasible = with(&plan, "/status", json!("feasible"));
    holds(&scenario, &feasible);
    holds(&scenario, &with(&feasible, "/bound", json!(null)));
    holds(&scenario, &with(&feasible, "/bound", json!(100)));
    breaks(&scenario, &with(&feasible, "/bound", json!(283)), "bound", "the tour is better");
    for bound in [json!(100), json!(283)] {
        breaks(&scenario, &with(&plan, "/bound", bound), "bound", "must equal the objective");
    }
    breaks(&scenario, &with(&plan, "/bound", json!(null)), "bound", "must prove");
    breaks(&reward(), &with(&reward_plan(), "/bound", json!(599)), "bound", "the tour is better");
    let count = with(&mobile_plan(), "/status", json!("feasible"));
    holds(&mobile(), &with(&count, "/bound", json!(3.0)));
    breaks(&mobile(), &with(&count, "/bound", json!(2.5)), "bound", "whole number");
    breaks(&mobile(), &with(&count, "/bound", json!(1)), "bound", "the tour is better");
    let stay = with(&example::stay_home(), "/status", json!("infeasible"));
    breaks(&scenario, &with(&stay, "/bound", json!(1)), "bound", "null where infeasible");
    holds(&scenario, &with(&example::stay_home(), "/bound", json!(1)));
}
