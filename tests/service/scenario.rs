//! What a departure is planned on, read from the scenario that is stored with its plan: ageing of
//! measured values, deadlines, dead sensors, sensors that another tour will charge, places.

use serde_json::{Value, json};
use voltour::proto::{
    Place, Point, ReportVisitRequest, SensorTrajectory, SubmitRequest, Tour, Trajectory,
    UpdateTrajectoryRequest, VisitOutcome, Waypoint, place,
};

use crate::app::TestApp;
use crate::calls::{EXPIRED, OPEN, PLANNED, listed, sensors};
use crate::field::{self, FIELD, at_rest, covered, fresh, line, request};
use crate::time::{from_now, us};

/// The entry of a sensor in a list of a scenario.
fn entry<'a>(scenario: &'a Value, list: &str, key: &str, sensor: &str) -> &'a Value {
    let items = scenario[list].as_array().expect("a list");
    items.iter().find(|item| item[key] == sensor).unwrap_or_else(|| panic!("no {sensor}"))
}

fn close(value: &Value, expected: f64) {
    let value = value.as_f64().unwrap_or_else(|| panic!("{value} in place of {expected}"));
    assert!((value - expected).abs() < 1e-3, "{value} in place of {expected}");
}

#[tokio::test]
async fn measured_values_age_until_the_start() {
    let app = TestApp::start().await;
    let mut spec = line(5);
    spec.sensors[2].drain_w = Some(3.0);
    app.put(spec).await;
    let measured_at = from_now(-10_000);
    let base = SubmitRequest { residual_j: Some(80.0), ..SubmitRequest::default() };
    let with = |sensor: &str, more: SubmitRequest| SubmitRequest {
        client_id: fresh("request"),
        network_id: FIELD.into(),
        sensor_id: sensor.into(),
        ..more
    };
    let aged = SubmitRequest { measured_at, drain_w: Some(2.0), ..base.clone() };
    app.submit(with("s1", aged.clone())).await;
    // Empty long ago.
    app.submit(with("s2", SubmitRequest { drain_w: Some(50.0), ..aged })).await;
    // Measured at the receipt, and the sensor's own drain.
    let received = app.submit(with("s3", base.clone())).await;
    // Nothing drains it.
    app.submit(with("s4", SubmitRequest { measured_at, ..base })).await;
    app.ask("s5").await;

    let tour = app.drive("A").await;
    let scenario = app.scenario(&tour).await;
    let residual = |sensor| &entry(&scenario, "requests", "sensor", sensor)["residual_j"];
    let since = |us: i64, start: i64| (start - us) as f64 / 1e6;
    let start = us(&tour.start);
    close(residual("s1"), 80.0 - 2.0 * since(us(&measured_at), start));
    close(residual("s2"), 0.0);
    close(residual("s3"), 80.0 - 3.0 * since(us(&received.received_at), start));
    close(residual("s4"), 80.0);
    assert!(residual("s5").is_null() || residual("s5") == 0.0, "unknown: the longest charge");
    close(&entry(&scenario, "requests", "sensor", "s1")["drain_w"], 2.0);
    close(&entry(&scenario, "requests", "sensor", "s3")["drain_w"], 3.0);
}

#[tokio::test]
async fn absolute_times_become_seconds_after_the_start() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let (ready, deadline) = (from_now(20_000), from_now(60_000));
    app.submit(SubmitRequest { ready, deadline, ..request("s1") }).await;
    let past = SubmitRequest { ready: from_now(-20_000), reward: Some(7.5), ..request("s2") };
    app.submit(SubmitRequest { required: true, ..past }).await;
    app.ask("s3").await;
    let tour = app.drive("A").await;
    let scenario = app.scenario(&tour).await;
    let seconds = |time| (us(&time) - us(&tour.start)) as f64 / 1e6;
    let first = entry(&scenario, "requests", "sensor", "s1");
    close(&first["ready_s"], seconds(ready));
    close(&first["deadline_s"], seconds(deadline));
    let second = entry(&scenario, "requests", "sensor", "s2");
    assert!(second["ready_s"].is_null() || second["ready_s"] == 0.0, "{second}");
    assert!(second["deadline_s"].is_null());
    assert_eq!((&second["reward"], &second["required"]), (&json!(7.5), &json!(true)));
    let third = entry(&scenario, "requests", "sensor", "s3");
    assert!(third["deadline_s"].is_null() && third["reward"].is_null(), "{third}");
    let stop = tour.stops.iter().find(|stop| stop.sensor_id == "s1").unwrap();
    assert!(us(&stop.arrive) >= us(&ready), "waits until it is ready");
}

/// Lets the request of `s1` expire, and gives back the tour that found that out.
async fn let_s1_die(app: &TestApp) -> Tour {
    app.put(covered(3, 1)).await;
    let dying = SubmitRequest { deadline: from_now(300), ..request("s1") };
    let dying = app.submit(dying).await;
    let tour = app.drive("A").await;
    assert_eq!(app.state(&dying.id).await, EXPIRED);
    let scenario = app.scenario(&tour).await;
    assert_eq!(listed(&scenario, "sensors", "id"), ["s2", "s3"], "dead at its own departure too");
    app.complete(&tour).await;
    tour
}

#[tokio::test]
async fn a_dead_sensor_is_left_out_until_a_newer_request_brings_it_back() {
    let app = TestApp::start().await;
    let_s1_die(&app).await;
    let tour = app.drive("A").await;
    assert_eq!(listed(&app.scenario(&tour).await, "sensors", "id"), ["s2", "s3"], "and next time");
    app.complete(&tour).await;
    // Without a deadline: whoever posts it says that the sensor lives, even if it is taken back.
    let newer = app.ask("s1").await;
    app.withdraw(&newer.id).await;
    let tour = app.drive("A").await;
    assert_eq!(listed(&app.scenario(&tour).await, "sensors", "id"), ["s1", "s2", "s3"]);
    app.complete(&tour).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    let scenario = app.scenario(&tour).await;
    assert_eq!(listed(&scenario, "sensors", "id"), ["s1", "s2", "s3"]);
    assert_eq!(listed(&scenario, "requests", "sensor"), ["s1"]);
}

#[tokio::test]
async fn a_dead_sensor_is_left_out_until_a_visit_brings_it_back() {
    let app = TestApp::start().await;
    let first = let_s1_die(&app).await;
    app.charged(&first, "s1").await;
    let tour = app.drive("A").await;
    assert_eq!(listed(&app.scenario(&tour).await, "sensors", "id"), ["s1", "s2", "s3"]);
}

#[tokio::test]
async fn a_skipped_visit_brings_no_dead_sensor_back() {
    let app = TestApp::start().await;
    let first = let_s1_die(&app).await;
    let skipped = field::visit(&first.id, "s1", VisitOutcome::Skipped);
    app.tours().report_visit(skipped).await.unwrap();
    let tour = app.drive("A").await;
    assert_eq!(listed(&app.scenario(&tour).await, "sensors", "id"), ["s2", "s3"]);
}

#[tokio::test]
async fn a_sensor_of_another_tour_counts_as_one_without_a_request() {
    let app = TestApp::start().await;
    app.put(covered(2, 2)).await;
    let held = app.ask("s1").await;
    let first = app.drive("A").await;
    assert_eq!(sensors(&first), ["s1"], "both are needed");
    let newer = app.ask("s1").await;
    app.ask("s2").await;
    let second = app.drive("B").await;
    let scenario = app.scenario(&second).await;
    assert_eq!(listed(&scenario, "sensors", "id"), ["s1", "s2"]);
    assert_eq!(listed(&scenario, "requests", "sensor"), ["s2"]);
    assert_eq!(sensors(&second), ["s2"]);
    assert_eq!((app.state(&held.id).await, app.state(&newer.id).await), (PLANNED, OPEN));
    assert_eq!(app.departure(&second.departure_id).await.batch_size, 1);
    // Once the first tour is over the newer one is anybody's.
    app.complete(&first).await;
    app.complete(&second).await;
    let third = app.drive("B").await;
    let scenario = app.scenario(&third).await;
    assert!(listed(&scenario, "requests", "sensor").contains(&"s1"));
}

#[tokio::test]
async fn a_request_may_say_where_its_sensor_is() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.submit(SubmitRequest { place: at_rest(0.0, 50.0), ..request("s1") }).await;
    app.ask("s2").await;
    let tour = app.drive("A").await;
    let scenario = app.scenario(&tour).await;
    assert_eq!(entry(&scenario, "sensors", "id", "s1")["position_m"], json!([0.0, 50.0]));
    assert_eq!(entry(&scenario, "sensors", "id", "s2")["position_m"], json!([20.0, 0.0]));
    let stop = tour.stops.iter().find(|stop| stop.sensor_id == "s1").unwrap();
    assert_eq!(stop.position_m, field::point(0.0, 50.0));
}

#[tokio::test]
async fn the_newest_trajectory_of_a_moving_sensor_is_planned_on() {
    let app = TestApp::start().await;
    let mut spec = line(2);
    spec.objective = voltour::proto::Objective::MaxCount as i32;
    spec.sensors[0].place = moving(&[(0, 10.0)]);
    app.put(spec).await;
    app.ask("s1").await;
    let (before, after) = (from_now(-60_000), from_now(60_000));
    let waypoints = vec![
        Waypoint { time: before, position_m: field::point(0.0, 100.0) },
        Waypoint { time: after, position_m: field::point(120.0, 100.0) },
    ];
    let update = UpdateTrajectoryRequest {
        client_id: fresh("trajectory"),
        network_id: FIELD.into(),
        trajectories: vec![SensorTrajectory {
            sensor_id: "s1".into(),
            trajectory: Some(Trajectory { waypoints }),
        }],
    };
    let updated = app.networks().update_trajectory(update).await.unwrap().into_inner();
    assert_eq!(updated.updated, 1);
    let tour = app.drive("A").await;
    let scenario = app.scenario(&tour).await;
    let rows = &entry(&scenario, "sensors", "id", "s1")["trajectory"];
    let seconds = |time| (us(&time) - us(&tour.start)) as f64 / 1e6;
    for (row, (time, x)) in [(before, 0.0), (after, 120.0)].into_iter().enumerate() {
        close(&rows[row][0], seconds(time));
        assert_eq!((&rows[row][1], &rows[row][2]), (&json!(x), &json!(100.0)));
    }
    assert_eq!(sensors(&tour), ["s1"]);
    let stop = &tour.stops[0];
    let met = stop.position_m.unwrap();
    let x = (us(&stop.arrive) - us(&before)) as f64 / 1e6;
    assert!((met.x_m - x).abs() < 1e-2 && met.y_m == 100.0, "met at {met:?}, not at {x}");
}

fn moving(rows: &[(i64, f64)]) -> Option<Place> {
    let waypoint = |&(ms, x_m): &(i64, f64)| Waypoint {
        time: from_now(ms),
        position_m: Some(Point { x_m, y_m: 0.0 }),
    };
    let waypoints = rows.iter().map(waypoint).collect();
    Some(Place { place: Some(place::Place::Trajectory(Trajectory { waypoints })) })
}

#[tokio::test]
async fn a_failed_visit_keeps_what_was_measured() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let tour = app.drive("A").await;
    let report = ReportVisitRequest {
        arrived_at: from_now(-2000),
        departed_at: from_now(-1000),
        charge_j: Some(12.5),
        note: "a flat battery".into(),
        ..field::visit(&tour.id, "s1", VisitOutcome::Failed)
    };
    let visit = app.tours().report_visit(report.clone()).await.unwrap().into_inner();
    assert_eq!(visit.reported, Some(report));
    assert!(visit.served_request_ids.is_empty() && visit.received_at.is_some());
    assert_eq!(app.state(&asked.id).await, PLANNED);
}
