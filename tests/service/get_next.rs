//! GetNext: waits for the plan within the caller's deadline, and returns the same tour again.

use std::time::Duration;

use tonic::{Code, Request};
use voltour::proto::{AnnounceRequest, GetNextRequest, Tour};

use crate::app::TestApp;
use crate::calls::{sensors, soon};
use crate::field::{FIELD, departure, line};
use crate::time::from_now;

fn next(charger: &str) -> GetNextRequest {
    GetNextRequest {
        network_id: FIELD.into(),
        charger_id: charger.into(),
        departure_id: String::new(),
    }
}

async fn get(app: &TestApp, charger: &str) -> Tour {
    soon("GetNext", app.tours().get_next(next(charger))).await.expect("GetNext").into_inner()
}

#[tokio::test]
async fn a_charger_without_a_departure_has_no_next_tour() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let refused = app.tours().get_next(next("A")).await.unwrap_err();
    assert_eq!(refused.code(), Code::FailedPrecondition, "{refused}");
}

#[tokio::test]
async fn it_waits_for_the_plan() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    app.ask("s1").await;
    let announced = app.announce(AnnounceRequest { t0: from_now(2000), ..departure("A") }).await;
    let (one, two) = tokio::join!(get(&app, "A"), get(&app, "A"));
    assert_eq!(one, two, "however many wait");
    assert_eq!((sensors(&one), &one.departure_id), (vec!["s1"], &announced.id));
}

#[tokio::test]
async fn it_waits_no_longer_than_the_caller() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("A") }).await;
    let mut short = Request::new(next("A"));
    short.set_timeout(Duration::from_millis(300));
    let refused = soon("the caller's deadline", app.tours().get_next(short)).await.unwrap_err();
    // Either side may notice first, and tonic's own limit has a code of its own.
    assert!(matches!(refused.code(), Code::DeadlineExceeded | Code::Cancelled), "{refused}");
}

#[tokio::test]
async fn the_same_tour_is_returned_again_also_after_a_crash() {
    let mut app = TestApp::start().await;
    app.put(line(3)).await;
    for sensor in ["s3", "s1"] {
        app.ask(sensor).await;
    }
    app.depart("A").await;
    let tour = get(&app, "A").await;
    assert_eq!(get(&app, "A").await, tour);
    app.restart().await;
    assert_eq!(get(&app, "A").await, tour);
    app.charged(&tour, "s1").await;
    app.restart().await;
    let reported = get(&app, "A").await;
    assert_eq!((&reported.id, sensors(&reported)), (&tour.id, sensors(&tour)));
    app.complete(&tour).await;
    app.restart().await;
    let refused = app.tours().get_next(next("A")).await.unwrap_err();
    assert_eq!(refused.code(), Code::FailedPrecondition, "completed: no longer the next one");
}

#[tokio::test]
async fn a_cancelled_departure_keeps_nobody_waiting() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let announced =
        app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("A") }).await;
    let (mut tours, waiting) = (app.tours(), next("A"));
    let waiting = tokio::spawn(async move { tours.get_next(waiting).await });
    tokio::time::sleep(Duration::from_millis(200)).await;
    app.cancel(&announced.id).await;
    let refused = soon("the end of the wait", waiting).await.unwrap().unwrap_err();
    assert_eq!(refused.code(), Code::FailedPrecondition, "{refused}");
}
