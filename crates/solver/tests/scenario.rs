//! The scenario document: each rule of the format broken by itself, each default, each refusal.

use serde_json::{Map, Value, json};
use voltour_solver::scenario::{Objective, Place, Point, Scenario, ScenarioError};

/// A good document that sets every field but `travel` and trajectories.
fn good() -> Value {
    json!({
        "format": "voltour/scenario/1",
        "name": "good",
        "objective": "min_distance",
        "charger": {
            "start_m": [250, 250], "end_m": [0, 0],
            "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20,
            "capacity_j": 1e6, "timespan_s": 9000
        },
        "charge_level": 0.9,
        "coverage": { "k": 1, "field_m": [[0, 0], [300, 0], [300, 300], [0, 300]] },
        "sensors": [
            { "id": "s1", "position_m": [150, 150], "range_m": 250, "battery_j": 10800 },
            { "id": "s2", "position_m": [50, 150], "range_m": 250, "battery_j": 10800 }
        ],
        "requests": [
            { "sensor": "s1", "ready_s": 10, "deadline_s": 5400, "residual_j": 1600,
              "drain_w": 0.3, "reward": 5, "required": true },
            { "sensor": "s2" }
        ]
    })
}

/// A good document of moving sensors; nothing in it but what is required.
fn moving() -> Value {
    json!({
        "format": "voltour/scenario/1",
        "objective": "max_count",
        "charger": { "start_m": [0, 0], "speed_mps": 5, "travel_jpm": 0, "transfer_w": 1 },
        "sensors": [{ "id": "m", "trajectory": [[-10, 0, 0], [10, 40, 0]], "battery_j": 1 }],
        "requests": [{ "sensor": "m" }]
    })
}

/// A good document with distances by matrix.
fn matrix() -> Value {
    let mut document = good();
    document["travel"] =
        json!({ "distance_m": [[0, 0, 1, 2], [0, 0, 3, 4], [5, 6, 0, 7], [8, 9, 1, 0]] });
    document
}

fn parse(document: &Value) -> Result<Scenario, ScenarioError> {
    Scenario::from_json(document.to_string().as_bytes())
}

#[track_caller]
fn accept(document: &Value) -> Scenario {
    parse(document).expect("a good document")
}

/// The document with the member at a pointer set; the last step may be new.
#[track_caller]
fn set(document: &Value, pointer: &str, value: Value) -> Value {
    let mut changed = document.clone();
    let (parent, last) = pointer.rsplit_once('/').expect("a pointer");
    match changed.pointer_mut(parent).expect("a parent") {
        Value::Object(members) => drop(members.insert(last.to_owned(), value)),
        Value::Array(items) => items[last.parse::<usize>().expect("an index")] = value,
        other => unreachable!("{other} has no members"),
    }
    changed
}

#[track_caller]
fn removed(document: &Value, pointer: &str) -> Value {
    let mut changed = document.clone();
    let (parent, last) = pointer.rsplit_once('/').expect("a pointer");
    let members = changed.pointer_mut(parent).and_then(Value::as_object_mut).expect("an object");
    members.remove(last).expect("was there");
    changed
}

/// The document is refused in one line that begins with the path and holds the words.
#[track_caller]
fn refused(document: &Value, path: &str, words: &str) {
    refused_text(&document.to_string(), path, words);
}

#[track_caller]
fn refused_text(text: &str, path: &str, words: &str) {
    let error = Scenario::from_json(text.as_bytes()).expect_err("must be refused");
    let line = error.to_string();
    assert!(line.starts_with(&format!("{path}: ")), "{line}\nis not at {path}");
    assert!(line.contains(words), "{line}\ndoes not say {words:?}");
    assert!(!line.contains('\n'), "{line}\nis more than one line");
    assert_eq!(error.path(), Some(path));
}

#[test]
fn good_documents_are_accepted() {
    let scenario = accept(&good());
    assert_eq!(scenario.name.as_deref(), Some("good"));
    assert_eq!(scenario.objective, Objective::MinDistance);
    assert_eq!(scenario.charger.end_m, Point::new(0.0, 0.0));
    assert_eq!((scenario.charger.capacity_j, scenario.charger.timespan_s), (Some(1e6), Some(9e3)));
    assert_eq!(scenario.charge_level, 0.9);
    assert_eq!(scenario.sensors[1].place, Place::Fixed(Point::new(50.0, 150.0)));
    let request = &scenario.requests[0];
    assert_eq!((request.sensor, request.ready_s, request.deadline_s), (0, 10.0, Some(5400.0)));
    assert_eq!((request.residual_j, request.drain_w, request.reward), (1600.0, 0.3, 5.0));
    assert!(request.required);
    assert_eq!(accept(&moving()).objective, Objective::MaxCount);
    let matrix = accept(&matrix()).travel.expect("a matrix");
    assert_eq!((matrix.size(), matrix.get(0, 3), matrix.get(3, 0)), (4, 2.0, 8.0));
    let max_reward = accept(&set(&good(), "/objective", json!("max_reward")));
    assert_eq!(max_reward.objective, Objective::MaxReward);
    let mut empty = good();
    empty["sensors"] = json!([]);
    empty["requests"] = json!([]);
    assert!(accept(&empty).sensors.is_empty());
}

/// Pointer, what is put there, path of the error, words in it.
fn wrong_values() -> Vec<(&'static str, Value, &'static str, &'static str)> {
    let long = "x".repeat(129);
    vec![
        ("/format", json!("voltour/scenario/2"), "format", "voltour/scenario/1"),
        ("/format", json!(1), "format", "a string"),
        ("/name", json!(7), "name", "a string"),
        ("/objective", json!("min_time"), "objective", "min_distance"),
        ("/objective", json!(["max_count"]), "objective", "a string"),
        ("/charger", json!([]), "charger", "an object"),
        ("/charger/start_m", json!([1]), "charger.start_m", "2 numbers"),
        ("/charger/start_m", json!([1, 2, 3]), "charger.start_m", "2 numbers"),
        ("/charger/start_m", json!([1, null]), "charger.start_m[1]", "a number"),
        ("/charger/end_m", json!(3), "charger.end_m", "a list"),
        ("/charger/end_m", json!(["a", 2]), "charger.end_m[0]", "a number"),
        ("/charger/speed_mps", json!(0), "charger.speed_mps", "> 0"),
        ("/charger/speed_mps", json!("5"), "charger.speed_mps", "a number"),
        ("/charger/travel_jpm", json!(-1), "charger.travel_jpm", ">= 0"),
        ("/charger/transfer_w", json!(0.0), "charger.transfer_w", "> 0"),
        ("/charger/capacity_j", json!(-1), "charger.capacity_j", ">= 0"),
        ("/charger/timespan_s", json!(-1e-9), "charger.timespan_s", ">= 0"),
        ("/charge_level", json!(0), "charge_level", "(0, 1]"),
        ("/charge_level", json!(1.000001), "charge_level", "(0, 1]"),
        ("/coverage", json!(1), "coverage", "an object"),
        ("/coverage/k", json!(0), "coverage.k", "whole number"),
        ("/coverage/k", json!(1.5), "coverage.k", "whole number"),
        ("/coverage/k", json!(-1), "coverage.k", "whole number"),
        ("/coverage/field_m", json!([[0, 0], [1]]), "coverage.field_m[1]", "2 numbers"),
        ("/sensors", json!({}), "sensors", "a list"),
        ("/sensors/0", json!(null), "sensors[0]", "an object"),
        ("/sensors/0/id", json!(""), "sensors[0].id", "1 to 128 bytes"),
        ("/sensors/0/id", json!(long), "sensors[0].id", "1 to 128 bytes"),
        ("/sensors/0/id", json!(1), "sensors[0].id", "a string"),
        ("/sensors/1/id", json!("s1"), "sensors[1].id", "unique"),
        ("/sensors/1/position_m", json!([1]), "sensors[1].position_m", "2 numbers"),
        ("/sensors/1/range_m", json!(0), "sensors[1].range_m", "> 0"),
        ("/sensors/0/battery_j", json!(0), "sensors[0].battery_j", "> 0"),
        ("/requests", json!("none"), "requests", "a list"),
        ("/requests/1/sensor", json!("s3"), "requests[1].sensor", "id of a sensor"),
        ("/requests/1/sensor", json!("s1"), "requests[1].sensor", "at most one request"),
        ("/requests/0/ready_s", json!(-1), "requests[0].ready_s", ">= 0"),
        ("/requests/0/ready_s", json!(5401), "requests[0].ready_s", "deadline"),
        ("/requests/0/deadline_s", json!(-1), "requests[0].deadline_s", ">= 0"),
        ("/requests/0/drain_w", json!(-0.1), "requests[0].drain_w", ">= 0"),
        ("/requests/0/residual_j", json!(-1), "requests[0].residual_j", ">= 0"),
        ("/requests/0/residual_j", json!(10801), "requests[0].residual_j", "battery"),
        ("/requests/0/reward", json!(-1), "requests[0].reward", ">= 0"),
        ("/requests/0/required", json!(1), "requests[0].required", "true or false"),
        ("/travel", json!([]), "travel", "an object"),
        ("/travel", json!({ "distance_m": [[0, 0, 0, 0]] }), "travel.distance_m", "4 rows"),
    ]
}

#[test]
fn wrong_values_are_refused_where_they_stand() {
    for (pointer, value, path, words) in wrong_values() {
        refused(&set(&good(), pointer, value), path, words);
    }
}

#[test]
fn values_at_the_edge_of_a_rule_are_accepted() {
    let edges = [
        ("/charger/travel_jpm", json!(0)),
        ("/charger/capacity_j", json!(0)),
        ("/charger/timespan_s", json!(0)),
        ("/charge_level", json!(1)),
        ("/charge_level", json!(1e-9)),
        ("/coverage/k", json!(3.0)),
        ("/coverage/k", json!(1e30)),
        ("/sensors/0/id", json!("é".repeat(64))),
        ("/name", json!("")),
        ("/requests/0/ready_s", json!(5400)),
        ("/requests/0/residual_j", json!(0)),
        ("/requests/0/residual_j", json!(10800)),
        ("/requests/0/reward", json!(0)),
        ("/requests/0/drain_w", json!(0)),
    ];
    for (pointer, value) in edges {
        let mut document = set(&good(), pointer, value);
        document["requests"][0]["sensor"] = document["sensors"][0]["id"].clone();
        accept(&document);
    }
    let mut closed = good();
    closed["requests"][0]["ready_s"] = json!(0);
    closed["requests"][0]["deadline_s"] = json!(0);
    accept(&closed);
    assert_eq!(accept(&set(&good(), "/coverage/k", json!(3.0))).coverage.unwrap().k, 3);
}

#[test]
fn required_fields_are_missing_by_their_own_path_and_so_is_null() {
    let required = [
        ("/format", "format"),
        ("/objective", "objective"),
        ("/charger", "charger"),
        ("/charger/start_m", "charger.start_m"),
        ("/charger/speed_mps", "charger.speed_mps"),
        ("/charger/travel_jpm", "charger.travel_jpm"),
        ("/charger/transfer_w", "charger.transfer_w"),
        ("/coverage/k", "coverage.k"),
        ("/coverage/field_m", "coverage.field_m"),
        ("/sensors", "sensors"),
        ("/sensors/1/id", "sensors[1].id"),
        ("/sensors/1/range_m", "sensors[1].range_m"),
        ("/sensors/1/battery_j", "sensors[1].battery_j"),
        ("/requests", "requests"),
        ("/requests/1/sensor", "requests[1].sensor"),
        ("/travel/distance_m", "travel.distance_m"),
    ];
    for (pointer, path) in required {
        refused(&removed(&matrix(), pointer), path, "missing");
        refused(&set(&matrix(), pointer, Value::Null), path, "missing");
    }
    let error = parse(&removed(&good(), "/sensors/1/position_m")).unwrap_err();
    assert!(error.path().unwrap().starts_with("sensors[1]"), "{error}");
    assert!(error.to_string().contains("exactly one of position_m and trajectory"), "{error}");
}

#[test]
fn unknown_fields_are_refused_by_their_path() {
    let places = [
        ("", "", ""),
        ("/charger", "charger", "charger."),
        ("/coverage", "coverage", "coverage."),
        ("/sensors/1", "sensors[1]", "sensors[1]."),
        ("/requests/0", "requests[0]", "requests[0]."),
        ("/travel", "travel", "travel."),
    ];
    for (pointer, parent, prefix) in places {
        let plain = set(&matrix(), &format!("{pointer}/speed"), Value::Null);
        refused(&plain, &format!("{prefix}speed"), "unknown field");
        let odd = set(&matrix(), &format!("{pointer}/a\nb"), json!(1));
        refused(&odd, &format!("{parent}[\"a\\nb\"]"), "unknown field");
    }
    refused_text("[]", "$", "an object");
    refused_text("null", "$", "an object");
}

#[test]
fn null_is_the_same_as_absent() {
    let optional = [
        "/name",
        "/charger/end_m",
        "/charger/capacity_j",
        "/charger/timespan_s",
        "/charge_level",
        "/requests/0/ready_s",
        "/requests/0/deadline_s",
        "/requests/0/residual_j",
        "/requests/0/drain_w",
        "/requests/0/reward",
        "/requests/0/required",
        "/travel",
        "/coverage",
    ];
    for pointer in optional {
        let absent = accept(&removed(&matrix(), pointer));
        let null = accept(&set(&matrix(), pointer, Value::Null));
        assert_eq!(format!("{absent:?}"), format!("{null:?}"), "{pointer}");
        let given = accept(&matrix());
        assert_ne!(format!("{absent:?}"), format!("{given:?}"), "{pointer} has an effect");
    }
    // Without coverage a range is optional, but never wrong.
    let free = set(&good(), "/coverage", Value::Null);
    assert_eq!(accept(&set(&free, "/sensors/0/range_m", Value::Null)).sensors[0].range_m, None);
    refused(&set(&free, "/sensors/0/range_m", json!(-1)), "sensors[0].range_m", "> 0");
}

#[test]
fn defaults() {
    let scenario = accept(&moving());
    assert_eq!(scenario.name, None);
    assert_eq!(scenario.charger.end_m, scenario.charger.start_m);
    assert_eq!((scenario.charger.capacity_j, scenario.charger.timespan_s), (None, None));
    assert_eq!(scenario.charge_level, 1.0);
    assert!(scenario.coverage.is_none() && scenario.travel.is_none());
    let request = &scenario.requests[0];
    assert_eq!((request.ready_s, request.deadline_s, request.drain_w), (0.0, None, 0.0));
    assert_eq!((request.residual_j, request.reward, request.required), (0.0, 1.0, false));
}

#[test]
fn residual_and_reward_by_default() {
    let request = |fields: Value| {
        let mut document = good();
        document["requests"][1] = fields;
        document["requests"][1]["sensor"] = json!("s2");
        let request = accept(&document).requests[1].clone();
        (request.residual_j, request.reward)
    };
    // The battery is 10,800 J, the level 0.9: 9,720 J.
    assert_eq!(request(json!({ "drain_w": 0.5, "deadline_s": 1000 })), (500.0, 9220.0));
    assert_eq!(request(json!({ "drain_w": 50, "deadline_s": 1000 })), (10_800.0, 0.0));
    assert_eq!(request(json!({ "drain_w": 0, "deadline_s": 1000 })), (0.0, 9720.0));
    assert_eq!(request(json!({ "drain_w": 0.5 })), (0.0, 9720.0));
    assert_eq!(request(json!({ "deadline_s": 1000 })), (0.0, 9720.0));
    assert_eq!(request(json!({ "drain_w": 0.5, "deadline_s": 0 })), (0.0, 9720.0));
    assert_eq!(
        request(json!({ "drain_w": 0.5, "deadline_s": 1000, "residual_j": 7 })),
        (7.0, 9713.0)
    );
    assert_eq!(request(json!({ "residual_j": 10_000 })), (10_000.0, 0.0));
    assert_eq!(request(json!({ "residual_j": 10_000, "reward": 3 })), (10_000.0, 3.0));
}

#[test]
fn already_charged_is_compared_in_doubles() {
    let charged = |residual: f64| {
        let scenario = accept(&set(&good(), "/requests/1/residual_j", json!(residual)));
        scenario.already_charged(&scenario.requests[1])
    };
    let target = 0.9 * 10_800.0;
    assert!(charged(target) && charged(10_800.0) && !charged(f64::next_down(target)));
}

#[test]
fn repeated_keys_are_refused_by_their_path() {
    let cases = [
        (r#"{"name": "a", "name": "a"}"#, "name"),
        (r#"{"charger": {"speed_mps": 1, "speed_mps": null}}"#, "charger.speed_mps"),
        (r#"{"sensors": [{}, {"id": "a", "id": "b"}]}"#, "sensors[1].id"),
        (r#"{"x": {"a\nb": 1, "a\nb": 2}}"#, "x[\"a\\nb\"]"),
        (r#"{"name": "a", "n\u0061me": "a"}"#, "name"),
    ];
    for (text, path) in cases {
        refused_text(text, path, "repeated");
    }
}

#[test]
fn text_that_is_not_json_is_refused_with_line_and_column() {
    let cases = [
        ("", 1, 0),
        ("{\n  \"name\": NaN\n}", 2, 11),
        ("{\n\n  \"name\": 1e999}", 3, 15),
        ("{\"name\": Infinity}", 1, 10),
        ("{\"name\": -1e999}", 1, 15),
        ("{} x", 1, 4),
        ("{}\n{}", 2, 1),
        ("{\"a\": 1,}", 1, 9),
        ("{\"a\": 01}", 1, 8),
        ("{'a': 1}", 1, 2),
        ("{\"a\": \"\t\"}", 1, 8),
        ("{\"a\": [1, 2", 1, 11),
        ("// no\n{}", 1, 1),
    ];
    for (text, line, column) in cases {
        let error = Scenario::from_json(text.as_bytes()).expect_err(text);
        let ScenarioError::Syntax { line: l, column: c, .. } = &error else {
            panic!("{text}: {error}")
        };
        assert!(*l == line && c.abs_diff(column) <= 1, "{text:?}: {error}");
        let shown = error.to_string();
        assert!(
            shown.contains(&format!("line {line}, column")) && !shown.contains('\n'),
            "{shown}"
        );
        assert_eq!(shown.matches("line").count(), 1, "said once: {shown}");
        assert_eq!(error.path(), None);
    }
    assert!(Scenario::from_json(b"{\"name\": \"\xff\"}").is_err(), "not UTF-8");
    let deep = "[".repeat(100_000);
    assert!(matches!(Scenario::from_json(deep.as_bytes()), Err(ScenarioError::Syntax { .. })));
}

#[test]
fn errors_are_one_line_whatever_the_ids_hold() {
    let id = "a\nb\u{2028}\"c";
    refused(&set(&good(), "/sensors/0/id", json!(id.repeat(20))), "sensors[0].id", "\\n");
    refused(&set(&good(), "/requests/1/sensor", json!(id)), "requests[1].sensor", "a\\nb");
    let mut twice = good();
    twice["sensors"][0]["id"] = json!(id);
    twice["sensors"][1]["id"] = json!(id);
    refused(&twice, "sensors[1].id", "a\\nb");
    refused(&set(&good(), "/objective", json!("\n")), "objective", "\"\\n\"");
}

#[test]
fn long_values_are_cut() {
    let rows: Vec<_> = (0..500).map(|i| [f64::from(i), 0.0]).collect();
    let line = parse(&set(&good(), "/coverage/field_m", json!(rows))).unwrap_err().to_string();
    assert!(line.len() < 300 && line.starts_with("coverage.field_m: [["), "{line}");
}

#[test]
fn fields_are_simple_polygons() {
    let field = |corners: Value| set(&good(), "/coverage/field_m", corners);
    let bad = [
        (json!([]), "three corners"),
        (json!([[0, 0], [1, 0]]), "three corners"),
        (json!([[0, 0], [10, 10], [10, 0], [0, 10]]), "cross or touch"),
        (json!([[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]), "repeated"),
        (json!([[0, 0], [10, 0], [10, 0], [10, 10]]), "repeated"),
        // A corner that touches an edge, and one that touches another corner.
        (json!([[0, 0], [10, 0], [10, 10], [5, 0], [0, 10]]), "cross or touch"),
        (
            json!([[0, 0], [4, 0], [5, 5], [6, 0], [10, 0], [10, 9], [5, 5], [0, 9]]),
            "cross or touch",
        ),
        // A spike: out and back along one line, whole or in part.
        (json!([[0, 0], [10, 0], [10, 10], [10, 20], [10, 5], [0, 10]]), "cross or touch"),
        (json!([[0, 0], [10, 0], [20, 0], [10, 0], [0, 10]]), "cross or touch"),
        (json!([[0, 0], [10, 0], [5, 0]]), "cross or touch"),
        (json!([[0, 0], [10, 0], [20, 0]]), "cross or touch"),
        (json!([[0, 0], [3, 0], [0, 0], [0, 3]]), "cross or touch"),
        // Edges that are apart but overlap along one line.
        (json!([[0, 0], [9, 0], [9, 5], [8, 5], [8, 0], [1, 0], [1, 5], [0, 5]]), "cross or touch"),
    ];
    for (corners, words) in bad {
        refused(&field(corners), "coverage.field_m", words);
    }
    let good = [
        (json!([[0, 0], [10, 0], [0, 10]]), 50.0),
        (json!([[0, 0], [0, 10], [10, 0]]), 50.0),
        (json!([[0, 0], [5, 0], [10, 0], [10, 5], [10, 10], [5, 10], [0, 10], [0, 5]]), 100.0),
        (json!([[0, 0], [10, 0], [10, 10], [5, 1], [0, 10]]), 55.0),
        (json!([[1e6, 1e6], [1000001, 1e6], [1e6, 1000001]]), 0.5),
    ];
    for (corners, area) in good {
        let coverage = accept(&field(corners)).coverage.unwrap();
        assert_eq!(coverage.field.area_m2(), area);
        let turn = |a: Point, b: Point| a.x * b.y - a.y * b.x;
        let twice: f64 = coverage.field.edges().map(|[a, b]| turn(a, b)).sum();
        assert!(twice > 0.0, "counter-clockwise whatever the document says");
    }
}

#[test]
fn trajectories() {
    let rows = |rows: Value| set(&moving(), "/sensors/0/trajectory", rows);
    let at = "sensors[0].trajectory";
    refused(&rows(json!([])), at, "at least one row");
    refused(&rows(json!([[0, 1]])), "sensors[0].trajectory[0]", "3 numbers");
    refused(&rows(json!([[0, 1, "2"]])), "sensors[0].trajectory[0][2]", "a number");
    refused(&rows(json!([[0, 0, 0], [0, 1, 1]])), "sensors[0].trajectory[1]", "rise strictly");
    refused(&rows(json!([[0, 0, 0], [5, 1, 1], [4, 1, 1]])), "sensors[0].trajectory[2]", "rise");
    // As fast as the charger is too fast.
    refused(
        &rows(json!([[0, 0, 0], [1, 3, 4]])),
        "sensors[0].trajectory[1]",
        "slower than the charger",
    );
    accept(&rows(json!([[0, 0, 0], [1.0001, 3, 4]])));
    accept(&rows(json!([[-1e6, 7, 7]])));
    let mut both = moving();
    both["sensors"][0]["position_m"] = json!([0, 0]);
    let error = parse(&both).unwrap_err();
    assert!(error.path().unwrap().starts_with("sensors[0]"), "{error}");
    assert!(error.to_string().contains("exactly one"), "{error}");
    let mut covered = moving();
    covered["sensors"][0]["range_m"] = json!(1);
    covered["coverage"] = good()["coverage"].clone();
    refused(&covered, "coverage", "trajector");
    let mut by_matrix = moving();
    by_matrix["travel"] = json!({ "distance_m": [[0, 0, 0], [0, 0, 0], [0, 0, 0]] });
    refused(&by_matrix, "travel.distance_m", "trajector");
}

#[test]
fn trajectories_rest_outside_their_rows() {
    let place = accept(&moving()).sensors[0].place.clone();
    let x = |t: f64| place.at(t).x;
    assert_eq!(
        [x(-20.0), x(-10.0), x(0.0), x(5.0), x(10.0), x(99.0)],
        [0.0, 0.0, 20.0, 30.0, 40.0, 40.0]
    );
}

#[test]
fn matrices() {
    let all = |rows: Value| set(&matrix(), "/travel/distance_m", rows);
    let at = |i: usize, j: usize, value: Value| {
        set(&matrix(), &format!("/travel/distance_m/{i}/{j}"), value)
    };
    refused(&all(json!(7)), "travel.distance_m", "a list");
    refused(&all(json!([[0]])), "travel.distance_m", "4 rows");
    let short = set(&matrix(), "/travel/distance_m/2", json!([0, 0, 0]));
    refused(&short, "travel.distance_m[2]", "4 numbers");
    let flat = set(&matrix(), "/travel/distance_m/2", json!(0));
    refused(&flat, "travel.distance_m[2]", "a list");
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        // Unused numbers (diagonal, column of start, row of end) are checked as well.
        let path = format!("travel.distance_m[{i}][{j}]");
        refused(&at(i, j, json!(-1)), &path, ">= 0");
        refused(&at(i, j, Value::Null), &path, "a number");
        accept(&at(i, j, json!(1e9)));
    }
}

#[test]
fn integers_of_any_size_are_numbers() {
    let text = good().to_string().replace("10800", "123456789012345678901234567890");
    let scenario = Scenario::from_json(text.as_bytes()).expect("a large number is a number");
    assert_eq!(scenario.sensors[0].battery_j, 123456789012345678901234567890.0);
}

#[test]
fn documents_in_memory_obey_the_same_rules() {
    let text = serde_json::to_string(&generated()).expect("documents are JSON");
    let read = Scenario::from_json(text.as_bytes()).expect("written documents are read");
    let direct = Scenario::from_document(&generated()).expect("valid");
    assert_eq!(format!("{read:?}"), format!("{direct:?}"));
    let mut wrong = generated();
    wrong.charger.speed_mps = f64::NAN;
    let line = Scenario::from_document(&wrong).unwrap_err().to_string();
    assert_eq!(line, "charger.speed_mps: null: must be > 0");
    let mut wrong = generated();
    wrong.charger.start_m[1] = f64::INFINITY;
    let error = Scenario::from_document(&wrong).unwrap_err();
    assert_eq!(error.path(), Some("charger.start_m"));
}

fn generated() -> voltour_solver::scenario::Document {
    let options = voltour_solver::generate::Mobile { sensors: 3, ..Default::default() };
    voltour_solver::generate::mobile(&options, 1).expect("drawn")
}

#[test]
fn members_of_objects_come_in_any_order() {
    let document = good();
    let members = document.as_object().expect("an object");
    let reversed: Map<String, Value> = members.clone().into_iter().rev().collect();
    accept(&Value::Object(reversed));
}
