//! A service that was down: it closes and plans late, with its own later second 0, or not at all.

use voltour::proto::{AnnounceRequest, DepartureState};

use crate::app::{Settings, TestApp};
use crate::calls::{OPEN, PLANNED, sensors};
use crate::field::{departure, line};
use crate::time::{from_now, now_us, pause, us};

#[tokio::test]
async fn a_batch_that_should_have_closed_while_it_was_down_is_planned_late() {
    let mut app = TestApp::start().await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let announced = app.announce(AnnounceRequest { t0: from_now(1000), ..departure("A") }).await;
    app.kill9();
    pause(1500).await;
    let back = now_us();
    app.launch().await;
    let tour = app.tour(&announced).await;
    assert_eq!(sensors(&tour), ["s1"]);
    let stored = app.departure(&announced.id).await;
    assert_eq!(us(&stored.t0), us(&announced.t0), "what was announced stays");
    assert!(
        us(&stored.start) >= back + 400_000,
        "nothing is planned from a second 0 that has passed"
    );
    assert_eq!(us(&stored.start), us(&tour.start));
    assert_eq!(app.state(&asked.id).await, PLANNED);
}

#[tokio::test]
async fn a_departure_that_is_too_late_is_missed() {
    let settings = Settings { max_late: "1s", ..Settings::default() };
    let mut app = TestApp::with(settings).await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let late = app.announce(AnnounceRequest { t0: from_now(1000), ..departure("A") }).await;
    app.kill9();
    pause(2500).await;
    app.launch().await;
    let missed = app.departure_in(&late.id, DepartureState::Missed).await;
    assert!(missed.plan_id.is_empty() && !missed.reason.is_empty(), "{missed:?}");
    assert_eq!(app.state(&asked.id).await, OPEN);
    // The next one gets what it left.
    let tour = app.drive("A").await;
    assert_eq!(sensors(&tour), ["s1"]);
}

#[tokio::test]
async fn waiting_for_a_missed_departure_is_refused() {
    let settings = Settings { max_late: "1s", ..Settings::default() };
    let mut app = TestApp::with(settings).await;
    app.put(line(1)).await;
    let late = app.announce(AnnounceRequest { t0: from_now(500), ..departure("A") }).await;
    app.kill9();
    pause(2000).await;
    app.launch().await;
    app.departure_in(&late.id, DepartureState::Missed).await;
    let next = voltour::proto::GetNextRequest {
        network_id: crate::field::FIELD.into(),
        charger_id: "A".into(),
        departure_id: late.id,
    };
    let refused = app.tours().get_next(next).await.unwrap_err();
    assert_eq!(refused.code(), tonic::Code::FailedPrecondition, "{refused}");
}
