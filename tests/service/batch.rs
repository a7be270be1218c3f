//! A batch is frozen when it closes, and what its plan leaves out is open again.

use voltour::proto::{AnnounceRequest, DepartureState};

use crate::app::{Settings, TestApp};
use crate::calls::{BATCHED, OPEN, PLANNED, SUPERSEDED, WITHDRAWN, sensors};
use crate::field::{self, charger_type, departure, line, sensor};

/// A search that takes its whole budget, so that its batch can be seen while it is planned.
fn slow() -> Settings {
    Settings { solver: "baseline", budget: "3s", lead: "5s", ..Settings::default() }
}

/// More than anybody plans to the optimum in a moment; the capacity leaves most of it unserved.
fn many() -> voltour::proto::NetworkSpec {
    let mut spec = line(60);
    for (i, sensor) in spec.sensors.iter_mut().enumerate() {
        let angle = i as f64 * 2.399963;
        let radius = 20.0 + 3.0 * i as f64;
        sensor.place = field::at_rest(radius * angle.cos(), radius * angle.sin());
    }
    spec.charger_types[0].capacity_j = Some(2500.0);
    spec
}

#[tokio::test]
async fn what_happens_while_a_batch_is_planned_concerns_the_next_departure() {
    let app = TestApp::with(slow()).await;
    app.put(many()).await;
    let mut ids = Vec::new();
    for number in 1..=60 {
        ids.push(app.ask(&sensor(number).id).await.id);
    }
    let announced = app.depart("A").await;
    let closed = app.departure_in(&announced.id, DepartureState::Closed).await;
    assert_eq!(closed.batch_size, 60);
    assert!(closed.start.is_some());
    let batched = app.request(&ids[0]).await;
    assert_eq!((batched.state, &batched.departure_id), (BATCHED, &announced.id));

    // Every second sensor takes its request back, the others ask again.
    let mut newer = Vec::new();
    for (i, id) in ids.iter().enumerate() {
        if i % 2 == 0 {
            let answer = app.withdraw(id).await;
            assert_eq!((answer.state, answer.withdrawal_pending), (BATCHED, true));
        } else {
            newer.push(app.ask(&sensor(i + 1).id).await);
        }
    }
    assert!(newer.iter().all(|request| request.state == OPEN));
    let still = app.departure(&announced.id).await;
    assert_eq!(still.state, DepartureState::Closed as i32, "the test was too slow to see it");

    let tour = app.tour(&announced).await;
    let stops: Vec<&str> = tour.stops.iter().map(|s| s.request_id.as_str()).collect();
    assert!(!stops.is_empty() && stops.len() < 60, "{} stops", stops.len());
    for (i, id) in ids.iter().enumerate() {
        let state = app.state(id).await;
        let expected = match (stops.contains(&id.as_str()), i % 2) {
            (true, _) => PLANNED,
            (false, 0) => WITHDRAWN,
            (false, _) => SUPERSEDED,
        };
        assert_eq!(state, expected, "request {i}");
    }
    for request in &newer {
        assert_eq!(app.state(&request.id).await, OPEN);
    }
}

#[tokio::test]
async fn what_the_plan_leaves_out_is_open_again() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (near, far) = (app.ask("s1").await, app.ask("s2").await);
    // 20 m and 100 J for the near one; 40 m and 200 J for both.
    let bounded = AnnounceRequest { capacity_j: Some(125.0), ..departure("A") };
    let bounded = app.announce(bounded).await;
    let tour = app.tour(&bounded).await;
    assert_eq!(sensors(&tour), ["s1"]);
    let left = app.request(&far.id).await;
    assert_eq!((app.state(&near.id).await, left.state), (PLANNED, OPEN));
    assert!(left.tour_id.is_empty());
    let plan = app.json(&format!("/v1/plans/{}", tour.plan_id)).await;
    assert_eq!(plan["plan"]["unserved"][0]["sensor"], "s2");
    assert_eq!(sensors(&app.drive("B").await), ["s2"], "the next departure has it");
}

#[tokio::test]
async fn no_open_request_makes_an_empty_tour() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let tour = app.drive("A").await;
    assert!(tour.stops.is_empty());
    assert_eq!((tour.distance_m, tour.charge_j, tour.start), (0.0, 0.0, tour.finish));
    let departure = app.departure(&tour.departure_id).await;
    assert_eq!((departure.state, departure.batch_size), (DepartureState::Planned as i32, 0));
    app.json(&format!("/v1/plans/{}", tour.plan_id)).await;
    app.complete(&tour).await;
}

#[tokio::test]
async fn an_announcement_replaces_what_the_charger_type_says() {
    let app = TestApp::start().await;
    let mut spec = line(3);
    let van = voltour::proto::ChargerType { name: "van".into(), speed_mps: 20.0, ..charger_type() };
    spec.charger_types.push(van);
    app.put(spec).await;
    app.ask("s1").await;
    let announced = AnnounceRequest {
        charger_type: "van".into(),
        start_m: field::point(10.0, 30.0),
        end_m: field::point(10.0, 40.0),
        capacity_j: Some(5000.0),
        timespan_s: Some(600.0),
        ..departure("A")
    };
    let departure = app.announce(announced).await;
    let tour = app.tour(&departure).await;
    let scenario = app.scenario(&tour).await;
    let charger = &scenario["charger"];
    assert_eq!(charger["speed_mps"], 20.0);
    assert_eq!(charger["start_m"], serde_json::json!([10.0, 30.0]));
    assert_eq!(charger["end_m"], serde_json::json!([10.0, 40.0]));
    assert_eq!((&charger["capacity_j"], &charger["timespan_s"]), (&5000.0.into(), &600.0.into()));
    assert_eq!((tour.start_m, tour.end_m), (field::point(10.0, 30.0), field::point(10.0, 40.0)));
    assert!((tour.distance_m - 70.0).abs() < 1e-6);
}
