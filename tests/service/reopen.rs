//! What a tour leaves unserved is open again: after Complete, after Cancel, and when nothing is heard.

use voltour::proto::{AnnounceRequest, DepartureState, TourState, VisitOutcome};

use crate::app::{Settings, TestApp};
use crate::calls::{OPEN, PLANNED, SERVED, sensors};
use crate::field::{self, line};
use crate::time::from_now;

#[tokio::test]
async fn complete_reopens_what_was_not_charged() {
    let app = TestApp::start().await;
    app.put(line(4)).await;
    let mut asked = Vec::new();
    for sensor in ["s1", "s2", "s3", "s4"] {
        asked.push(app.ask(sensor).await.id);
    }
    let tour = app.drive("A").await;
    assert_eq!(tour.stops.len(), 4);
    app.charged(&tour, "s1").await;
    for (sensor, outcome) in [("s2", VisitOutcome::Skipped), ("s3", VisitOutcome::Failed)] {
        let visit = field::visit(&tour.id, sensor, outcome);
        let visit = app.tours().report_visit(visit).await.unwrap().into_inner();
        assert!(visit.served_request_ids.is_empty());
    }
    for id in &asked[1..] {
        assert_eq!(app.state(id).await, PLANNED, "it stays planned while its tour is out");
    }
    let over = app.complete(&tour).await;
    let mut outcomes: Vec<_> =
        over.stops.iter().map(|stop| (stop.sensor_id.as_str(), stop.outcome)).collect();
    outcomes.sort();
    assert_eq!(outcomes, [("s1", 1), ("s2", 2), ("s3", 3), ("s4", 0)]);
    assert_eq!(app.state(&asked[0]).await, SERVED);
    for id in &asked[1..] {
        assert_eq!(app.state(id).await, OPEN);
    }
    // They are planned again, by whoever leaves next.
    let next = app.drive("B").await;
    let mut again = sensors(&next);
    again.sort_unstable();
    assert_eq!(again, ["s2", "s3", "s4"]);
}

#[tokio::test]
async fn cancelling_a_planned_departure_calls_its_tour_back() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (one, two) = (app.ask("s1").await, app.ask("s2").await);
    let tour = app.drive("A").await;
    app.charged(&tour, "s1").await;
    let departure = app.cancel(&tour.departure_id).await;
    assert_eq!(departure.state, DepartureState::Cancelled as i32);
    assert_eq!(departure.reason, "the charger broke down");
    assert_eq!((app.state(&one.id).await, app.state(&two.id).await), (SERVED, OPEN));
    assert_eq!(app.tour_state(&tour.id).await, "cancelled");
}

#[tokio::test]
async fn cancelling_an_announced_departure_leaves_its_requests_open() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let announced = AnnounceRequest { t0: from_now(3_600_000), ..field::departure("A") };
    let departure = app.announce(announced).await;
    assert_eq!(departure.state, DepartureState::Announced as i32);
    let departure = app.cancel(&departure.id).await;
    assert_eq!(departure.state, DepartureState::Cancelled as i32);
    assert_eq!(app.state(&asked.id).await, OPEN);
    // Nothing that was called off comes back.
    assert_eq!(sensors(&app.drive("B").await), ["s1"]);
    assert_eq!(app.departure(&departure.id).await.state, DepartureState::Cancelled as i32);
}

#[tokio::test]
async fn what_is_over_cannot_be_cancelled_or_completed_otherwise() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let tour = app.drive("A").await;
    app.complete(&tour).await;
    let refused =
        app.departures().cancel(field::cancellation(&tour.departure_id)).await.unwrap_err();
    assert_eq!(refused.code(), tonic::Code::FailedPrecondition);

    let tour = app.drive("A").await;
    app.cancel(&tour.departure_id).await;
    let refused = app.tours().complete(field::completion(&tour.id)).await.unwrap_err();
    assert_eq!(refused.code(), tonic::Code::FailedPrecondition);
}

#[tokio::test]
async fn a_tour_of_which_nothing_is_heard_is_overdue() {
    let settings = Settings { overdue_after: "1s", ..Settings::default() };
    let app = TestApp::with(settings).await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    // 1 s there, 5 s of charging, 1 s back, 1 s of patience.
    let tour = app.drive("A").await;
    assert_eq!(app.state(&asked.id).await, PLANNED);
    let departure = app.departure_in(&tour.departure_id, DepartureState::Overdue).await;
    assert_eq!(departure.plan_id, tour.plan_id);
    assert_eq!(app.state(&asked.id).await, OPEN);
    assert_eq!(app.tour_state(&tour.id).await, "overdue");
    // The charger is free for another tour, and the end of the first may still be reported or refused.
    let next = app.drive("A").await;
    assert_eq!((sensors(&next), next.state), (vec!["s1"], TourState::Out as i32));
}
