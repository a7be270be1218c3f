//! Cancellation reaches the search: a budget is long here, and nobody waits for it.

use voltour::proto::{DepartureState, NetworkSpec};

use crate::app::{Settings, TestApp};
use crate::field::{at_rest, line, sensor};
use crate::metrics::{metrics, value};
use crate::time::until;

/// A search takes ten minutes where it is not ended.
fn patient() -> Settings {
    Settings { solver: "baseline", budget: "10m", lead: "11m", ..Settings::default() }
}

/// Sensors all over a plane, with a charger that cannot serve all of them: no tour is soon proven to be the best.
fn scattered() -> NetworkSpec {
    let mut spec = line(80);
    for (i, sensor) in spec.sensors.iter_mut().enumerate() {
        let (angle, radius) = (i as f64 * 2.399963, 20.0 + 3.0 * i as f64);
        sensor.place = at_rest(radius * angle.cos(), radius * angle.sin());
    }
    spec.charger_types[0].capacity_j = Some(3000.0);
    spec
}

async fn asked(app: &TestApp) {
    app.put(scattered()).await;
    for number in 1..=80 {
        app.ask(&sensor(number).id).await;
    }
}

async fn searches(app: &TestApp) {
    until("a search runs", || async {
        let text = metrics(app).await;
        (value(&text, "voltour_planner_running_departures") == Some(1.0)).then_some(())
    })
    .await;
}

#[tokio::test]
async fn a_departure_that_is_called_off_ends_its_search_and_the_next_one_begins() {
    let app = TestApp::with(patient()).await;
    asked(&app).await;
    let first = app.depart("A").await;
    app.departure_in(&first.id, DepartureState::Closed).await;
    searches(&app).await;
    let second = app.depart("B").await;
    app.cancel(&first.id).await;
    let closed = app.departure_in(&second.id, DepartureState::Closed).await;
    assert_eq!(closed.batch_size, 80, "the requests went over to it");
    searches(&app).await;
    assert_eq!(app.departure(&first.id).await.state, DepartureState::Cancelled as i32);
    assert!(!app.log().contains("a defect"), "{}", app.log());
}

#[tokio::test]
async fn the_end_of_the_service_ends_a_search() {
    let mut app = TestApp::with(patient()).await;
    asked(&app).await;
    let departure = app.depart("A").await;
    app.departure_in(&departure.id, DepartureState::Closed).await;
    searches(&app).await;
    assert_eq!(app.sigterm().await.code(), Some(0), "within lifecycle.stop_within");
}

#[tokio::test]
async fn requests_are_taken_while_a_tour_is_planned() {
    let app = TestApp::with(patient()).await;
    asked(&app).await;
    let departure = app.depart("A").await;
    app.departure_in(&departure.id, DepartureState::Closed).await;
    searches(&app).await;
    for number in 1..=80 {
        app.ask(&sensor(number).id).await;
    }
    let still = app.departure(&departure.id).await;
    assert_eq!(still.state, DepartureState::Closed as i32, "the search goes on");
}
