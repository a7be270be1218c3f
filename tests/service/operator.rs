//! The operator's commands against a running service: a whole round from the command line.

use std::fs;
use std::process::{Command, Output};

use serde_json::{Value, json};

use crate::app::TestApp;
use crate::calls::OPEN;
use crate::field::FIELD;

fn voltour(app: &TestApp, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(args)
        .env("VOLTOUR_SERVER", &app.grpc)
        .output()
        .expect("voltour runs")
}

/// The objects that a command prints; it must succeed.
fn objects(app: &TestApp, args: &[&str]) -> Vec<Value> {
    let output = voltour(app, &[args, &["--json"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.lines().map(|line| serde_json::from_str(line).expect("one object a line")).collect()
}

fn network(app: &TestApp) -> String {
    let sensor = |n: u32| json!({"id": format!("s{n}"), "battery_j": 100, "place": {"position_m": [10 * n, 0]}});
    let document = json!({
        "id": FIELD,
        "objective": "max_reward",
        "charger_types": [
            {"name": "truck", "speed_mps": 10, "travel_jpm": 1, "transfer_w": 20, "start_m": [0, 0]}
        ],
        "sensors": [sensor(1), sensor(2), sensor(3)],
    });
    let file = app.file("network.json");
    fs::write(&file, document.to_string()).unwrap();
    file.to_str().unwrap().to_owned()
}

#[tokio::test]
async fn the_round_from_the_command_line() {
    let app = TestApp::start().await;
    let put = objects(&app, &["network", "put", &network(&app)]);
    assert_eq!((&put[0]["id"], &put[0]["version"]), (&json!(FIELD), &json!(1)));
    let got = objects(&app, &["network", "get", FIELD]);
    assert_eq!(got[0]["spec"]["sensors"][2]["id"], "s3");

    let common = ["--network", FIELD];
    let submit = ["request", "submit", "--sensor", "s1", "--in", "10m", "--residual-j", "5"];
    let submitted = objects(&app, &[&submit[..], &common].concat());
    assert_eq!(
        (&submitted[0]["state"], &submitted[0]["sensor_id"]),
        (&json!("open"), &json!("s1"))
    );
    let file = app.file("requests.ndjson");
    fs::write(&file, "{\"sensor_id\": \"s2\"}\n{\"sensor_id\": \"s3\", \"reward\": 7}\n").unwrap();
    let submit = ["request", "submit", "--file", file.to_str().unwrap()];
    assert_eq!(objects(&app, &[&submit[..], &common].concat()).len(), 2);
    let listed = objects(&app, &[&["request", "list", "--state", "open"][..], &common].concat());
    assert_eq!(listed.len(), 3);

    let charger = ["--network", FIELD, "--charger", "A"];
    let departure = objects(&app, &[&["depart"][..], &charger].concat());
    let id = departure[0]["id"].as_str().unwrap();
    let get = ["tour", "get", "--departure", id, "--wait", "30s"];
    let tour = objects(&app, &[&get[..], &charger].concat());
    assert_eq!(tour[0]["stops"].as_array().unwrap().len(), 3);
    assert_eq!(tour[0]["departure_id"], id);

    let lost = objects(&app, &[&["charger", "lost"][..], &charger].concat());
    assert_eq!((&lost[0]["id"], &lost[0]["state"]), (&json!(id), &json!("cancelled")));
    for request in &submitted {
        assert_eq!(app.state(request["id"].as_str().unwrap()).await, OPEN);
    }
}

#[tokio::test]
async fn what_the_service_refuses_is_said_with_the_field() {
    let app = TestApp::start().await;
    voltour(&app, &["network", "put", &network(&app)]);
    let refused = voltour(
        &app,
        &["request", "submit", "--network", FIELD, "--sensor", "s1", "--residual-j", "101"],
    );
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_ne!(refused.status.code(), Some(0));
    assert!(refused.stdout.is_empty() && said.contains("residual_j"), "{said}");
    let refused = voltour(&app, &["network", "get", "nowhere"]);
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_ne!(refused.status.code(), Some(0));
    assert!(said.contains("nowhere"), "{said}");
}

#[tokio::test]
async fn an_absent_service_is_said_in_one_line() {
    let mut app = TestApp::start().await;
    app.kill9();
    let refused = voltour(&app, &["network", "list"]);
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_ne!(refused.status.code(), Some(0));
    assert!(said.contains(&app.grpc) && said.lines().count() == 1, "{said}");
}

#[tokio::test]
async fn health_is_an_exit_code() {
    let mut app = TestApp::start().await;
    assert_eq!(voltour(&app, &["health"]).status.code(), Some(0));
    app.kill9();
    let dead = voltour(&app, &["health"]);
    assert_eq!(dead.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&dead.stderr).contains("no service answers"));
}
