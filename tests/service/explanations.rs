//! Explanations: made after the plan without delaying it, stored with it, served as JSON and as text; also
//! of plans that were there before.

use std::process::Command;

use reqwest::StatusCode;
use reqwest::header::{ACCEPT, CACHE_CONTROL, CONTENT_TYPE, ETAG, IF_NONE_MATCH, VARY};
use serde_json::Value;
use voltour::proto::{SubmitRequest, Tour};

use crate::app::{PATIENCE, Settings, TestApp};
use crate::calls::{MOMENT, listed};
use crate::database::{open, rows};
use crate::field::{at_rest, covered, line, request, sensor};
use crate::time::{from_now, until};

/// No plan is explained.
fn off() -> Settings {
    Settings { explanation_budget: "0s", ..Settings::default() }
}

fn path(tour: &Tour) -> String {
    format!("/v1/plans/{}/explanation", tour.plan_id)
}

/// The explanation of a tour's plan, once there is one.
pub async fn explanation(app: &TestApp, tour: &Tour) -> Value {
    until("the explanation", || async {
        let answer = app.get(&path(tour)).await;
        let found = answer.status() == StatusCode::OK;
        let document: Value = answer.json().await.expect("JSON");
        found.then_some(document)
    })
    .await
}

/// Nothing is explained, and the answer says that this may change.
pub async fn not_yet(app: &TestApp, tour: &Tour) {
    let answer = app.get(&path(tour)).await;
    assert_eq!(answer.status(), StatusCode::NOT_FOUND);
    let problem: Value = answer.json().await.unwrap();
    assert_eq!(problem["title"], "Not explained yet");
    assert_eq!(problem["type"], "tag:voltour,2026:not-explained-yet");
}

/// A tour that leaves `s2` out: the charger has no energy for it.
async fn drive(app: &TestApp) -> Tour {
    let mut spec = line(2);
    spec.charger_types[0].capacity_j = Some(130.0);
    app.put(spec).await;
    app.ask("s1").await;
    app.ask("s2").await;
    app.drive("A").await
}

#[tokio::test]
async fn a_plan_is_explained_in_json_and_in_words() {
    let app = TestApp::start().await;
    let tour = drive(&app).await;
    let document = explanation(&app, &tour).await;
    assert_eq!(document["format"], "voltour/explanation/1");
    assert_eq!(document["complete"], true);
    let (served, unserved) = (&document["served"], &document["unserved"]);
    assert_eq!((served.as_array().unwrap().len(), unserved.as_array().unwrap().len()), (1, 1));
    assert_eq!(unserved[0]["insertion"]["breaks"][0]["kind"], "capacity");

    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    let address = format!("{}{}", app.rest, path(&tour));
    let asked = client.get(format!("{address}?format=text")).send().await.unwrap();
    let liked = client.get(&address).header(ACCEPT, "text/plain").send().await.unwrap();
    let json = client.get(&address).send().await.unwrap();
    for answer in [&asked, &liked, &json] {
        assert!(answer.headers()[CACHE_CONTROL].to_str().unwrap().contains("immutable"));
        assert_eq!(answer.headers()[VARY], "accept");
    }
    assert_eq!(json.headers()[CONTENT_TYPE], "application/json");
    assert_eq!(asked.headers()[CONTENT_TYPE], "text/plain; charset=utf-8");
    assert_eq!(asked.headers()[ETAG], liked.headers()[ETAG]);
    assert_ne!(asked.headers()[ETAG], json.headers()[ETAG]);
    let known = client.get(&address).header(IF_NONE_MATCH, &json.headers()[ETAG]);
    assert_eq!(known.send().await.unwrap().status(), StatusCode::NOT_MODIFIED);
    let text = asked.text().await.unwrap();
    assert_eq!(text, liked.text().await.unwrap());
    assert!(text.contains("s1") && text.contains("s2") && text.contains("capacity"), "{text}");
}

#[tokio::test]
async fn what_cannot_be_is_told_with_the_constraints_that_contradict_each_other() {
    let app = TestApp::start().await;
    let mut spec = line(2);
    spec.sensors[0].place = at_rest(1000.0, 0.0);
    app.put(spec).await;
    // The charger needs 100 s.
    let deadline = from_now(30_000);
    app.submit(SubmitRequest { deadline, required: true, ..request("s1") }).await;
    app.ask("s2").await;
    let tour = app.drive("A").await;
    let document = explanation(&app, &tour).await;
    assert_eq!(document["status"], "infeasible");
    let conflict = &document["conflict"];
    let kinds = listed(conflict, "clauses", "kind");
    assert_eq!(kinds, ["required", "deadline"]);
    let text = app.get(&format!("{}?format=text", path(&tour))).await.text().await.unwrap();
    assert!(text.contains(conflict["sentence"].as_str().unwrap()), "{text}");
}

#[tokio::test]
async fn it_is_what_the_command_says_of_the_same_documents() {
    let app = TestApp::start().await;
    let tour = drive(&app).await;
    let document = explanation(&app, &tour).await;
    let (scenario, plan) = (app.file("scenario.json"), app.file("plan.json"));
    std::fs::write(&scenario, app.scenario(&tour).await.to_string()).unwrap();
    let envelope = app.json(&format!("/v1/plans/{}", tour.plan_id)).await;
    std::fs::write(&plan, envelope["plan"].to_string()).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
    command.arg("explain").args([&scenario, &plan]).args(["--format", "json", "--seed", "7"]);
    let said: Value = serde_json::from_slice(&command.output().unwrap().stdout).unwrap();
    assert_eq!(said, document);
}

#[tokio::test]
async fn bad_questions_are_problems() {
    let app = TestApp::start().await;
    let tour = drive(&app).await;
    explanation(&app, &tour).await;
    let answer = app.get(&format!("{}?format=poem", path(&tour))).await;
    assert_eq!(answer.status(), StatusCode::BAD_REQUEST);
    let stranger = "/v1/plans/01890a5d-ac96-774b-bcce-b302099a8057/explanation";
    let answer = app.get(stranger).await;
    assert_eq!(answer.status(), StatusCode::NOT_FOUND);
    let problem: Value = answer.json().await.unwrap();
    assert_eq!((&problem["title"], &problem["type"]), (&"Not Found".into(), &"about:blank".into()));
}

#[tokio::test]
async fn switched_off_nothing_is_explained_and_switched_on_again_what_there_is() {
    let mut app = TestApp::with(off()).await;
    let tour = drive(&app).await;
    tokio::time::sleep(MOMENT).await;
    not_yet(&app, &tour).await;
    app.kill9();
    app.configure(Settings::default());
    app.launch().await;
    let document = explanation(&app, &tour).await;
    assert_eq!(document["scenario"], tour.departure_id.as_str());
    // Once is enough: it stays through the next start.
    app.restart().await;
    assert_eq!(app.json(&path(&tour)).await, document);
}

/// A tour of which it takes long to say what would make it shorter.
async fn drive_far(app: &TestApp) -> Tour {
    let mut spec = covered(40, 20);
    for (i, sensor) in spec.sensors.iter_mut().enumerate() {
        let (angle, radius) = (i as f64 * 2.399963, 20.0 + 3.0 * i as f64);
        sensor.place = at_rest(radius * angle.cos(), radius * angle.sin());
    }
    spec.charger_types[0].capacity_j = Some(3000.0);
    app.put(spec).await;
    for number in 1..=40 {
        let residual_j = Some(2.0 * number as f64);
        let id = sensor(number).id;
        app.submit(SubmitRequest { residual_j, ..request(&id) }).await;
    }
    app.drive("A").await
}

async fn attempts(app: &TestApp) -> Vec<Vec<String>> {
    let mut conn = open(&app.database()).await;
    rows(
        &mut conn,
        "SELECT CAST(attempts AS TEXT), CAST(document IS NULL AS TEXT) FROM explanations",
    )
    .await
}

#[tokio::test]
async fn the_end_of_the_service_does_not_wait_for_an_explanation() {
    let settings = Settings { explanation_budget: "10m", ..Settings::default() };
    let mut app = TestApp::with(settings).await;
    let tour = drive_far(&app).await;
    until("the begin", || async { Some(attempts(&app).await).filter(|rows| !rows.is_empty()) })
        .await;
    assert_eq!(app.sigterm().await.code(), Some(0));
    // On a fast machine it was done in time.
    let left = attempts(&app).await;
    assert!(left == [["0", "1"]] || left == [["1", "0"]], "what was cut short counts: {left:?}");
    app.configure(Settings { explanation_budget: "100ms", ..Settings::default() });
    app.launch().await;
    explanation(&app, &tour).await;
}
