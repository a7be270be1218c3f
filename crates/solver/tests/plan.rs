//! The plan document: exactly the fields of the format, each with its type.

use serde_json::{Value, json};
use voltour_solver::plan::{Plan, Reason, Status, Violation, Warning};

fn good() -> Value {
    json!({
        "format": "voltour/plan/1",
        "scenario": "small", "status": "best_effort", "solver": "exact",
        "objective": 282.5, "bound": 1.5,
        "distance_m": 282.5, "travel_j": 169705, "charge_j": 9188.5, "finish_s": 515,
        "stops": [{ "sensor": "s1", "position_m": [150, 150.5], "arrive_s": 28.5,
                    "depart_s": 487.5, "charge_j": 9188.5 }],
        "unserved": [{ "sensor": "s2", "reason": "no_capacity" }],
        "violations": [
            { "kind": "required", "sensor": "s2" },
            { "kind": "coverage", "at_m": [1, 2], "needs": 3, "has": 2.0 },
            { "kind": "timespan", "limit": 10, "needs": 11 },
            { "kind": "capacity", "limit": 20, "needs": 21 }
        ],
        "warnings": [{ "kind": "below_k", "at_m": [3, 4], "needs": 2, "has": 1 }],
        "elapsed_s": 0.25
    })
}

#[track_caller]
fn refused(document: &Value, path: &str, words: &str) {
    let error = Plan::from_json(document.to_string().as_bytes()).expect_err("must be refused");
    let line = error.to_string();
    assert_eq!(error.path(), Some(path), "{line}");
    assert!(line.contains(words) && !line.contains('\n'), "{line}\ndoes not say {words:?}");
}

#[track_caller]
fn set(pointer: &str, value: Value) -> Value {
    let mut changed = good();
    *changed.pointer_mut(pointer).expect("leads somewhere") = value;
    changed
}

#[track_caller]
fn object<'a>(document: &'a mut Value, pointer: &str) -> &'a mut serde_json::Map<String, Value> {
    document.pointer_mut(pointer).and_then(Value::as_object_mut).expect("an object")
}

#[test]
fn a_good_plan_is_read_and_written_back() {
    let plan = Plan::from_json(good().to_string().as_bytes()).expect("a plan");
    assert_eq!((plan.scenario.as_deref(), plan.status), (Some("small"), Status::BestEffort));
    assert_eq!((plan.objective, plan.bound, plan.elapsed_s), (282.5, Some(1.5), 0.25));
    assert_eq!((plan.stops[0].position_m, plan.stops[0].arrive_s), ([150.0, 150.5], 28.5));
    assert_eq!(plan.unserved[0].reason, Reason::NoCapacity);
    assert_eq!(plan.violations[1], Violation::Coverage { at_m: [1.0, 2.0], needs: 3, has: 2 });
    assert_eq!(plan.violations[2], Violation::Timespan { limit: 10.0, needs: 11.0 });
    assert_eq!(plan.violations[3], Violation::Capacity { limit: 20.0, needs: 21.0 });
    assert_eq!(plan.warnings, [Warning::BelowK { at_m: [3.0, 4.0], needs: 2, has: 1 }]);
    let text = serde_json::to_string(&plan).expect("plans are JSON");
    assert_eq!(Plan::from_json(text.as_bytes()), Ok(plan));
}

#[test]
fn fields_are_written_with_null_where_there_is_nothing() {
    let mut document = good();
    document["scenario"] = Value::Null;
    document["bound"] = Value::Null;
    let plan = Plan::from_json(document.to_string().as_bytes()).expect("a plan");
    let written = serde_json::to_value(&plan).expect("plans are JSON");
    assert_eq!((&written["scenario"], &written["bound"]), (&Value::Null, &Value::Null));
    let keys =
        |value: &Value| value.as_object().expect("an object").keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&written), keys(&good()));
}

#[test]
fn every_field_must_be_there() {
    let names: Vec<String> = good().as_object().expect("an object").keys().cloned().collect();
    assert_eq!(names.len(), 15);
    for name in names {
        let mut document = good();
        object(&mut document, "").remove(&name);
        refused(&document, &name, "missing");
    }
    let inner = [
        ("/stops/0", "stops[0]"),
        ("/unserved/0", "unserved[0]"),
        ("/violations/0", "violations[0]"),
        ("/violations/1", "violations[1]"),
        ("/violations/2", "violations[2]"),
        ("/violations/3", "violations[3]"),
        ("/warnings/0", "warnings[0]"),
    ];
    for (pointer, path) in inner {
        let names: Vec<String> = object(&mut good(), pointer).keys().cloned().collect();
        for name in names {
            let mut document = good();
            object(&mut document, pointer).remove(&name);
            refused(&document, &format!("{path}.{name}"), "missing");
        }
    }
}

#[test]
fn no_other_field_may_be_there() {
    for (pointer, prefix) in [
        ("", ""),
        ("/stops/0", "stops[0]."),
        ("/unserved/0", "unserved[0]."),
        ("/warnings/0", "warnings[0]."),
    ] {
        let mut document = good();
        object(&mut document, pointer).insert("extra".into(), Value::Null);
        refused(&document, &format!("{prefix}extra"), "unknown field");
    }
    // Each kind of violation has fields of its own.
    let foreign = [(0, "at_m"), (0, "limit"), (1, "sensor"), (1, "limit"), (2, "has"), (3, "at_m")];
    for (i, name) in foreign {
        let mut document = good();
        object(&mut document, &format!("/violations/{i}")).insert(name.into(), json!(1));
        refused(&document, &format!("violations[{i}].{name}"), "unknown field");
    }
}

#[test]
fn wrong_values_are_refused_where_they_stand() {
    let wrong = [
        ("/format", json!("voltour/plan/2"), "format", "voltour/plan/1"),
        ("/scenario", json!(1), "scenario", "a string"),
        ("/status", json!("good"), "status", "best_effort"),
        ("/solver", json!(null), "solver", "missing"),
        ("/objective", json!("1"), "objective", "a number"),
        ("/bound", json!("none"), "bound", "a number"),
        ("/distance_m", json!([]), "distance_m", "a number"),
        ("/travel_j", json!(null), "travel_j", "missing"),
        ("/stops", json!({}), "stops", "a list"),
        ("/stops/0/position_m", json!([1]), "stops[0].position_m", "2 numbers"),
        ("/stops/0/sensor", json!(1), "stops[0].sensor", "a string"),
        ("/unserved/0/reason", json!("tired"), "unserved[0].reason", "not_chosen"),
        ("/violations/0/kind", json!("late"), "violations[0].kind", "required, coverage"),
        ("/violations/1/needs", json!(1.5), "violations[1].needs", "whole number"),
        ("/violations/1/has", json!(-1), "violations[1].has", "whole number"),
        ("/violations/1/has", json!(1e10), "violations[1].has", "whole number"),
        ("/violations/2/limit", json!("x"), "violations[2].limit", "a number"),
        ("/warnings/0/kind", json!("above_k"), "warnings[0].kind", "below_k"),
        ("/warnings/0/at_m", json!([1, 2, 3]), "warnings[0].at_m", "2 numbers"),
        ("/elapsed_s", json!(true), "elapsed_s", "a number"),
    ];
    for (pointer, value, path, words) in wrong {
        refused(&set(pointer, value), path, words);
    }
}

#[test]
fn repeated_keys_are_refused() {
    let text = good().to_string().replacen("\"needs\":3", "\"needs\":3,\"needs\":3", 1);
    let error = Plan::from_json(text.as_bytes()).expect_err("must be refused");
    assert_eq!(error.path(), Some("violations[1].needs"), "{error}");
    assert!(Plan::from_json(b"{\"status\": NaN}").is_err_and(|error| error.path().is_none()));
}
