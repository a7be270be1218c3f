//! Time zero: when a departure's batch closes, and which second 0 its scenario counts from.

use voltour::proto::{AnnounceRequest, DepartureState};

use crate::app::TestApp;
use crate::calls::{OPEN, sensors};
use crate::field::{departure, line};
use crate::time::{from_now, now_us, us, wire};

/// The lead of the usual settings, in microseconds.
const LEAD: i64 = 400_000;
const DAY_MS: i64 = 86_400_000;

#[tokio::test]
async fn without_t0_a_charger_leaves_a_lead_from_now() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let before = now_us();
    let announced = app.depart("A").await;
    let after = now_us();
    assert!((before + LEAD..=after + LEAD).contains(&us(&announced.t0)));
    assert_eq!(us(&announced.t0) - us(&announced.closes_at), LEAD);
    assert_eq!(
        announced.announced.as_ref().unwrap().t0,
        None,
        "what was announced is kept as it was"
    );
    let tour = app.tour(&announced).await;
    let stored = app.departure(&announced.id).await;
    assert!(us(&stored.closes_at) >= us(&announced.closes_at), "never closes early");
    assert_eq!(us(&tour.start), us(&stored.start));
    assert!(us(&stored.start) >= us(&stored.closes_at) + LEAD);
}

#[tokio::test]
async fn a_batch_stays_open_until_a_lead_before_t0() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    // Whole microseconds: that is what is stored.
    let t0 = now_us() + 3_000_000;
    let announced = app.announce(AnnounceRequest { t0: Some(wire(t0)), ..departure("A") }).await;
    assert_eq!(announced.state, DepartureState::Announced as i32);
    assert_eq!((us(&announced.t0), us(&announced.closes_at)), (t0, t0 - LEAD));
    assert!(announced.start.is_none());
    let asked = app.ask("s1").await;
    assert_eq!(asked.state, OPEN);
    let tour = app.tour(&announced).await;
    assert_eq!(sensors(&tour), ["s1"], "asked after the announcement, before the close");
    let stored = app.departure(&announced.id).await;
    let closed_late = us(&stored.closes_at) + LEAD;
    assert_eq!(us(&tour.start), us(&stored.start));
    assert!(us(&stored.start) >= t0.max(closed_late));
    assert!(us(&stored.closes_at) >= t0 - LEAD);
}

#[tokio::test]
async fn a_t0_that_has_just_passed_is_planned_from_a_second_0_to_come() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    app.ask("s1").await;
    let before = now_us();
    let announced = app.announce(AnnounceRequest { t0: from_now(-20_000), ..departure("A") }).await;
    let tour = app.tour(&announced).await;
    assert_eq!(sensors(&tour), ["s1"]);
    assert!(us(&tour.start) >= before + LEAD);
}

#[tokio::test]
async fn t0_lies_between_30_seconds_ago_and_7_days_ahead() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    for (ms, fine) in [
        (-60_000, false),
        (-10_000, true),
        (7 * DAY_MS - 60_000, true),
        (7 * DAY_MS + 60_000, false),
        (400 * DAY_MS, false),
    ] {
        let charger = format!("c{ms}").replace('-', "m");
        let announced = AnnounceRequest { t0: from_now(ms), ..departure(&charger) };
        match app.departures().announce(announced).await {
            Ok(_) => assert!(fine, "{ms} ms was accepted"),
            Err(refused) => {
                assert!(!fine, "{ms} ms: {refused}");
                assert_eq!(crate::bad_input::violations(&refused), ["t0"]);
            }
        }
    }
}
