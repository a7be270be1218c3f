//! Databases as every released schema left them, stored beside this file: each opens, with all that is in it, and
//! the service plans on.
//!
//! A new migration gets its database by `VOLTOUR_WRITE_RELEASED=1 cargo test --workspace --test service released`; those
//! of before are never written again.

use std::path::{Path, PathBuf};

use serde_json::Value;
use voltour::proto::{
    AnnounceRequest, DepartureState, SensorTrajectory, SubmitRequest, Trajectory,
    UpdateTrajectoryRequest, Waypoint,
};

use crate::app::{Settings, TestApp};
use crate::calls::sensors;
use crate::database::{open, open_copy, rows};
use crate::explanations::explanation;
use crate::field::{FIELD, departure, fresh, line, point, request};
use crate::time::{from_now, wire};
use crate::upgrade::{migrations, of_version};

/// What no upgrade and no time that has passed may change.
const KEPT: [&str; 8] = [
    "SELECT network_id, version, hex(spec), sensor_count, created_us FROM network_versions ORDER BY 1, 2",
    "SELECT network_id, sensor_id, waypoints, updated_us FROM trajectories ORDER BY 1, 2",
    "SELECT scope, client_id, hex(fingerprint), answer, created_us FROM calls ORDER BY 1, 2",
    "SELECT id, network_id, sensor_id, client_id, hex(fingerprint), place, deadline_us, ready_us, residual_j, \
     measured_us, drain_w, reward, required, withdraw_us, received_us, \
     CASE WHEN state IN ('open', 'batched', 'planned') THEN '' ELSE state END FROM requests ORDER BY 1",
    "SELECT id, charger_id, charger_type, client_id, hex(fingerprint), announced, t0_us, announced_us, \
     CASE WHEN state IN ('announced', 'closed', 'planned', 'overdue', 'missed') THEN '' ELSE state END \
     FROM departures WHERE charger_id <> 'N' ORDER BY 1",
    "SELECT p.id, departure_id, revision, status, solver, objective, bound, hex(envelope), hex(scenario), created_us \
     FROM plans p WHERE charger_id <> 'N' ORDER BY 1",
    "SELECT s.tour_id, position, request_id, sensor_id, x_m, y_m, arrive_us, depart_us, s.charge_j, outcome \
     FROM stops s JOIN tours t ON t.id = s.tour_id WHERE t.charger_id <> 'N' ORDER BY 1, 2",
    "SELECT id, tour_id, client_id, hex(fingerprint), sensor_id, outcome, arrived_us, note, served, received_us \
     FROM visits ORDER BY 1",
];

fn stored(version: u32) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/service/durability/released");
    folder.join(format!("schema-{version}.db.zst"))
}

async fn kept(database: &Path) -> Vec<Vec<Vec<String>>> {
    let mut conn = open(database).await;
    let mut all = Vec::new();
    for sql in KEPT {
        all.push(rows(&mut conn, sql).await);
    }
    all
}

#[tokio::test]
async fn every_released_schema_opens_with_all_that_is_in_it_and_plans_on() {
    for version in migrations().into_keys() {
        let file = stored(version);
        if !file.exists() && std::env::var_os("VOLTOUR_WRITE_RELEASED").is_some() {
            write(version, &file).await;
        }
        let packed = std::fs::read(&file).unwrap_or_else(|error| {
            panic!("{}: {error}; see the head of this file", file.display())
        });
        let before = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(before.path(), zstd::decode_all(&packed[..]).unwrap()).unwrap();
        let expected = kept(before.path()).await;
        for (sql, found) in KEPT.iter().zip(&expected) {
            assert!(!found.is_empty(), "schema {version} has nothing for {sql}");
        }

        let settings = Settings { explanation_budget: "0s", ..Settings::default() };
        let app = TestApp::over(settings, |database| {
            std::fs::copy(before.path(), database).unwrap();
        });
        let app = app.await;
        assert_eq!(kept(&app.database()).await, expected, "schema {version}");
        let plans = app.json("/v1/plans?limit=500").await;
        let plans: Vec<&Value> = plans["items"].as_array().unwrap().iter().collect();
        assert_eq!(plans.len(), expected[5].len());
        for plan in plans {
            let id = plan["id"].as_str().unwrap();
            let envelope = app.json(&format!("/v1/plans/{id}")).await;
            assert!(envelope["plan"].is_object(), "{envelope}");
            let scenario = app.json(&format!("/v1/plans/{id}/scenario")).await;
            assert_eq!(scenario["format"], "voltour/scenario/1");
        }
        let asked = app.ask("s4").await;
        let tour = app.drive("N").await;
        assert!(tour.stops.iter().any(|stop| stop.request_id == asked.id), "{:?}", sensors(&tour));
        app.complete(&tour).await;
        assert_eq!(kept(&app.database()).await[5], expected[5], "the plans are as they were");
    }
}

/// A database with something of everything that a schema has.
async fn write(version: u32, file: &Path) {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    app.put(line(5)).await;
    let over = {
        app.ask("s1").await;
        app.ask("s1").await;
        let tour = app.drive("A").await;
        app.charged(&tour, "s1").await;
        app.complete(&tour).await;
        tour
    };
    explanation(&app, &over).await;
    let paths = SensorTrajectory {
        sensor_id: "s5".into(),
        trajectory: Some(Trajectory {
            waypoints: vec![Waypoint { time: Some(wire(1_000_000)), position_m: point(3.0, 4.0) }],
        }),
    };
    let moved = UpdateTrajectoryRequest {
        client_id: fresh("move"),
        network_id: FIELD.into(),
        trajectories: vec![paths],
    };
    app.networks().update_trajectory(moved).await.unwrap();
    let late = SubmitRequest { deadline: from_now(300), ..request("s3") };
    app.submit(late).await;
    app.submit(SubmitRequest { residual_j: Some(20.0), ..request("s2") }).await;
    let taken = app.ask("s5").await;
    app.withdraw(&taken.id).await;
    let cancelled = app.drive("B").await;
    app.cancel(&cancelled.departure_id).await;
    let out = app.drive("A").await;
    app.departure_in(&out.departure_id, DepartureState::Planned).await;
    app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("B") }).await;
    assert_eq!(app.sigterm().await.code(), Some(0));
    let old = app.file("old.db");
    of_version(version, &app.database(), &old).await;
    let mut conn = open_copy(&old).await;
    sqlx::query("VACUUM").execute(&mut conn).await.unwrap();
    sqlx::Connection::close(conn).await.unwrap();
    let packed = zstd::encode_all(&std::fs::read(&old).unwrap()[..], 19).unwrap();
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(file, packed).unwrap();
}
