//! Trained policies: whatever model the service is given, it plans; a good one is used, and exchanged while
//! the service runs.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;
use voltour::proto::Tour;

use crate::app::{Settings, TestApp};
use crate::field::line;
use crate::metrics::metrics;
use crate::onnx::Onnx;
use crate::time::until;

/// A folder with this file as the policy for `line`, which asks for the most reward.
fn folder(reward: Option<&[u8]>) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    if let Some(bytes) = reward {
        put(folder.path(), bytes);
    }
    folder
}

fn put(folder: &Path, reward: &[u8]) {
    fs::write(folder.join("reward.onnx"), reward).unwrap();
}

/// A server whose policies come from a folder.
async fn start(folder: &Path, solver: &'static str) -> TestApp {
    let more = format!("[policy]\nfolder = {folder:?}\n");
    // Time enough on a busy machine: what is asked here is proven long before.
    let (budget, lead) = ("10s", "11s");
    let app = TestApp::with(Settings { more, solver, budget, lead, ..Settings::default() }).await;
    app.put(line(3)).await;
    app
}

/// A tour, and where it came from.
async fn planned(app: &TestApp, charger: &str) -> (Tour, Value) {
    for sensor in ["s1", "s2", "s3"] {
        app.ask(sensor).await;
    }
    let tour = app.drive(charger).await;
    assert_eq!(tour.stops.len(), 3, "nothing keeps it from planning");
    let provenance = app.json(&format!("/v1/plans/{}", tour.plan_id)).await["provenance"].take();
    (tour, provenance)
}

/// Waits until something is counted so often.
async fn counted(app: &TestApp, line: &str) {
    until(line, || async { metrics(app).await.lines().any(|said| said == line).then_some(()) })
        .await;
}

#[tokio::test]
async fn with_whatever_model_every_departure_is_planned_and_the_reason_is_told() {
    let good = Onnx::of("reward").bytes();
    let old = Onnx { version: "0".into(), ..Onnx::of("reward") }.bytes();
    let nan = Onnx { factor: f32::NAN, ..Onnx::of("reward") }.bytes();
    let wide = Onnx { features: 40, ..Onnx::of("reward") }.bytes();
    let mobile = Onnx::of("mobile").bytes();
    let models: [(&str, &[u8]); 6] = [
        ("damaged", &good[..good.len() / 2]),
        ("damaged", b""),
        ("wrong_version", &old),
        ("wrong_problem", &mobile),
        ("wrong_shape", &wide),
        ("not_finite", &nan),
    ];
    for (reason, bytes) in models {
        let folder = folder(Some(bytes));
        let app = start(folder.path(), "auto").await;
        told(&app, reason, "reward.onnx").await;
    }
    let app = start(Path::new("/no/such/folder"), "auto").await;
    told(&app, "no_model", "/no/such/folder").await;
    // The policy alone was asked for.
    let folder = folder(Some(&nan));
    let app = start(folder.path(), "dqn").await;
    told(&app, "not_finite", "reward.onnx").await;
}

/// The reason why there is no policy stands in the stored plan, in the metrics, and in the log.
async fn told(app: &TestApp, reason: &str, file: &str) {
    let (tour, provenance) = planned(app, "A").await;
    let said = provenance["fallback_reason"].as_str().unwrap();
    assert!(said.starts_with(&format!("policy: {reason}: ")) && said.contains(file), "{said}");
    assert!(provenance["policy"].is_null());
    assert_eq!(provenance["winner"], tour.solver.as_str());
    counted(app, &format!("voltour_policy_fallbacks_total{{reason=\"{reason}\"}} 1")).await;
    assert!(app.log().contains("no policy: tours are planned without one"));
}

#[tokio::test]
async fn sighup_takes_a_good_model_and_refuses_a_bad_one() {
    let folder = folder(Some(&Onnx::of("reward").bytes()));
    let mut app = start(folder.path(), "auto").await;
    let in_use = |app: &TestApp| app.log().matches("policy in use").count();
    let before = in_use(&app);
    assert!(before >= 1);
    put(folder.path(), &Onnx { factor: f32::INFINITY, ..Onnx::of("reward") }.bytes());
    app.sighup();
    counted(&app, "voltour_policy_reloads_total{outcome=\"refused\"} 1").await;
    assert!(app.log().contains("a new policy is refused"));
    // It is still there, and plans.
    let (tour, provenance) = planned(&app, "A").await;
    assert!(provenance["fallback_reason"].is_null(), "{provenance}");
    app.complete(&tour).await;
    put(folder.path(), &Onnx { factor: 2.0, ..Onnx::of("reward") }.bytes());
    app.sighup();
    counted(&app, "voltour_policy_reloads_total{outcome=\"taken\"} 1").await;
    assert_eq!(in_use(&app), before + 1);
    let (_, provenance) = planned(&app, "A").await;
    assert!(provenance["fallback_reason"].is_null(), "{provenance}");
    assert_eq!(app.sigterm().await.code(), Some(0));
}

#[tokio::test]
async fn the_policy_that_was_asked_is_recorded_and_a_new_one_takes_its_place() {
    let folder = folder(Some(&Onnx::of("reward").bytes()));
    let app = start(folder.path(), "dqn").await;
    let (tour, provenance) = planned(&app, "A").await;
    let first = provenance["policy"].clone();
    assert_eq!((&first["name"], &first["problem"]), (&"reward".into(), &"reward".into()));
    assert_eq!(first["digest"].as_str().unwrap().len(), 64);
    assert_eq!((&provenance["winner"], tour.solver.as_str()), (&"dqn".into(), "dqn"));
    counted(&app, "voltour_policy_wins_total{winner=\"policy\"} 1").await;
    app.complete(&tour).await;
    put(folder.path(), &Onnx { factor: 2.0, ..Onnx::of("reward") }.bytes());
    app.sighup();
    counted(&app, "voltour_policy_reloads_total{outcome=\"taken\"} 1").await;
    let (_, provenance) = planned(&app, "A").await;
    assert_eq!(provenance["policy"]["name"], "reward");
    assert_ne!(provenance["policy"]["digest"], first["digest"]);
}
