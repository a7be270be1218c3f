//! What is stored with a plan: it passes `voltour check`, and `voltour solve` makes its tour again.

use std::fs;
use std::process::{Command, Output};

use reqwest::StatusCode;
use reqwest::header::{CACHE_CONTROL, ETAG, IF_NONE_MATCH};
use serde_json::Value;
use voltour::proto::{SubmitRequest, Tour};

use crate::app::{PATIENCE, Settings, TestApp};
use crate::field::{at_rest, covered, line, request, sensor};
use crate::time::from_now;

fn voltour(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_voltour")).args(args).output().expect("voltour runs")
}

/// Stores a tour's scenario and plan beside the database, and gives back the provenance.
async fn documents(app: &TestApp, tour: &Tour) -> (String, String, Value) {
    let mut envelope = app.json(&format!("/v1/plans/{}", tour.plan_id)).await;
    let scenario = app.get(&format!("/v1/plans/{}/scenario", tour.plan_id)).await;
    let (scenario_file, plan_file) = (app.file("scenario.json"), app.file("plan.json"));
    fs::write(&scenario_file, scenario.bytes().await.unwrap()).unwrap();
    fs::write(&plan_file, envelope["plan"].to_string()).unwrap();
    let name = |path: std::path::PathBuf| path.to_str().unwrap().to_owned();
    (name(scenario_file), name(plan_file), envelope["provenance"].take())
}

/// The stored plan holds, and is made again from what its provenance records.
async fn checks_and_repeats(app: &TestApp, tour: &Tour) {
    let (scenario, plan, provenance) = documents(app, tour).await;
    let checked = voltour(&["check", &scenario, &plan]);
    let said = String::from_utf8_lossy(&checked.stdout);
    assert_eq!(checked.status.code(), Some(0), "check says {said}");

    let number = |member: &str| provenance[member].as_u64().expect("a number").to_string();
    let asked = provenance["asked"].as_str().unwrap();
    let (seed, iterations) = (number("seed"), number("iterations"));
    let mut arguments = vec!["solve", &scenario, "--solver", asked];
    arguments.extend(["--seed", &seed, "--iterations", &iterations]);
    // In a slow build the policy takes more than its share, and the plan is made as without one.
    let reason = provenance["fallback_reason"].as_str().unwrap_or_default();
    if reason.starts_with("policy: ") && !reason.starts_with("policy: no_tour") {
        arguments.push("--no-policy");
    }
    let again = voltour(&arguments);
    let said = String::from_utf8_lossy(&again.stderr);
    let again: Value = serde_json::from_slice(&again.stdout)
        .unwrap_or_else(|error| panic!("solve printed no plan: {error}: {said}"));
    let stops = |plan: &Value| -> Vec<String> {
        let stops = plan["stops"].as_array().expect("stops");
        stops.iter().map(|stop| stop["sensor"].as_str().expect("a sensor").to_owned()).collect()
    };
    let driven: Vec<_> = tour.stops.iter().map(|stop| stop.sensor_id.clone()).collect();
    assert_eq!(stops(&again), driven, "provenance {provenance}");
    assert_eq!(provenance["winner"], tour.solver.as_str());
    assert_eq!(provenance["seed"], 7, "as it was configured");
    assert_eq!(provenance["check"], serde_json::json!(["holds"]));
    assert!(!provenance["contenders"].as_array().unwrap().is_empty());
    assert_eq!(provenance["versions"]["network"], 1);
    assert_eq!(provenance["versions"]["scenario_format"], "voltour/scenario/1");
}

#[tokio::test]
async fn a_small_tour() {
    let app = TestApp::start().await;
    app.put(covered(6, 3)).await;
    for number in [1, 3, 4, 6] {
        app.ask(&sensor(number).id).await;
    }
    checks_and_repeats(&app, &app.drive("A").await).await;
}

#[tokio::test]
async fn an_empty_tour() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    checks_and_repeats(&app, &app.drive("A").await).await;
}

#[tokio::test]
async fn a_tour_that_took_the_whole_budget() {
    for solver in ["auto", "baseline"] {
        let app = TestApp::with(Settings { solver, lead: "1s", ..Settings::default() }).await;
        let mut spec = line(70);
        for (i, sensor) in spec.sensors.iter_mut().enumerate() {
            let (angle, radius) = (i as f64 * 2.399963, 20.0 + 3.0 * i as f64);
            sensor.place = at_rest(radius * angle.cos(), radius * angle.sin());
        }
        spec.charger_types[0].capacity_j = Some(3000.0);
        app.put(spec).await;
        for number in 1..=70 {
            let deadline = from_now(60_000 + 10_000 * number as i64).filter(|_| number % 3 == 0);
            let residual_j = Some(number as f64);
            let id = sensor(number).id;
            app.submit(SubmitRequest { deadline, residual_j, ..request(&id) }).await;
        }
        let tour = app.drive("A").await;
        assert!(!tour.stops.is_empty());
        checks_and_repeats(&app, &tour).await;
    }
}

#[tokio::test]
async fn a_plan_never_changes_and_says_so() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    for path in ["", "/scenario"] {
        let address = format!("{}/v1/plans/{}{path}", app.rest, tour.plan_id);
        let first = client.get(&address).send().await.unwrap();
        let tag = first.headers().get(ETAG).expect("an ETag").clone();
        assert!(first.headers().contains_key(CACHE_CONTROL), "{path}");
        let known = client.get(&address).header(IF_NONE_MATCH, &tag).send().await.unwrap();
        assert_eq!(known.status(), StatusCode::NOT_MODIFIED, "{path}");
        assert_eq!(known.headers().get(ETAG), Some(&tag));
        assert!(known.bytes().await.unwrap().is_empty());
        let other = client.get(&address).header(IF_NONE_MATCH, "\"another\"").send().await.unwrap();
        assert_eq!(other.status(), StatusCode::OK, "{path}");
        let before = first.bytes().await.unwrap();
        app.charged(&tour, "s1").await;
        let after = client.get(&address).send().await.unwrap();
        assert_eq!(after.headers().get(ETAG), Some(&tag));
        assert_eq!(after.bytes().await.unwrap(), before);
    }
}
