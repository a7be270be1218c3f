//! A request's life: open, batched, planned, served; or expired, withdrawn, superseded.

use voltour::proto::{DepartureState, ReportVisitRequest, SubmitRequest, TourState, VisitOutcome};

use crate::app::TestApp;
use crate::calls::{EXPIRED, OPEN, PLANNED, SERVED, SUPERSEDED, WITHDRAWN, listed, sensors};
use crate::field::{self, line, point, request};
use crate::time::{from_now, us};

#[tokio::test]
async fn a_request_is_planned_and_served() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let asked = SubmitRequest { residual_j: Some(20.0), ..request("s2") };
    let open = app.submit(asked.clone()).await;
    assert_eq!(open.state, OPEN);
    assert_eq!(open.submitted, Some(asked));
    assert!(open.departure_id.is_empty() && open.tour_id.is_empty());
    let version = uuid::Uuid::parse_str(&open.id).unwrap().get_version_num();
    assert_eq!(version, 7, "ids sort by the time of their making");

    let departure = app.depart("A").await;
    let tour = app.tour(&departure).await;
    assert_eq!(sensors(&tour), ["s2"]);
    let stop = &tour.stops[0];
    assert_eq!(stop.request_id, open.id);
    assert_eq!((stop.position_m, stop.outcome), (point(20.0, 0.0), 0));
    assert_eq!((tour.revision, tour.number, tour.state), (1, 1, TourState::Out as i32));
    assert!((stop.charge_j - 80.0).abs() < 1e-6, "charges what is missing: {}", stop.charge_j);
    assert_eq!(us(&stop.arrive) - us(&tour.start), 2_000_000, "20 m with 10 m/s");
    assert_eq!(us(&stop.depart) - us(&stop.arrive), 4_000_000, "80 J with 20 W");
    assert_eq!(us(&tour.finish) - us(&stop.depart), 2_000_000);

    let planned = app.request(&open.id).await;
    assert_eq!(planned.state, PLANNED);
    assert_eq!((&planned.departure_id, &planned.tour_id), (&departure.id, &tour.id));
    let departure = app.departure(&departure.id).await;
    assert_eq!(departure.state, DepartureState::Planned as i32);
    assert_eq!((departure.batch_size, &departure.plan_id), (1, &tour.plan_id));
    assert_eq!(departure.tour_ids, [tour.id.as_str()]);
    assert_eq!(us(&departure.start), us(&tour.start));

    let visit = app.charged(&tour, "s2").await;
    assert_eq!(visit.served_request_ids, [open.id.as_str()]);
    assert_eq!(app.state(&open.id).await, SERVED);

    let over = app.complete(&tour).await;
    assert_eq!(over.state, TourState::Completed as i32);
    assert_eq!(over.stops[0].outcome, VisitOutcome::Charged as i32);
    let departure = app.departure(&departure.id).await;
    assert_eq!(departure.state, DepartureState::Completed as i32);
    assert_eq!(app.state(&open.id).await, SERVED, "what was served stays served");
}

#[tokio::test]
async fn a_request_whose_deadline_is_before_the_start_expires() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    // The lead alone is longer.
    let late = SubmitRequest { deadline: from_now(300), ..request("s1") };
    let late = app.submit(late).await;
    let fine = app.ask("s2").await;
    let tour = app.drive("A").await;
    assert_eq!(sensors(&tour), ["s2"]);
    assert_eq!((app.state(&late.id).await, app.state(&fine.id).await), (EXPIRED, PLANNED));
    let scenario = app.scenario(&tour).await;
    assert_eq!(listed(&scenario, "requests", "sensor"), ["s2"]);
}

#[tokio::test]
async fn an_open_request_is_withdrawn_at_once() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let asked = app.ask("s1").await;
    let answer = app.withdraw(&asked.id).await;
    assert_eq!((answer.state, answer.withdrawal_pending), (WITHDRAWN, false));
    assert!(app.drive("A").await.stops.is_empty());
    assert_eq!(app.state(&asked.id).await, WITHDRAWN);
    // The sensor may ask again.
    assert_eq!(app.ask("s1").await.state, OPEN);
}

#[tokio::test]
async fn a_withdrawal_of_a_planned_request_waits_for_its_tour() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (served, left) = (app.ask("s1").await, app.ask("s2").await);
    let tour = app.drive("A").await;
    for id in [&served.id, &left.id] {
        let answer = app.withdraw(id).await;
        assert_eq!((answer.state, answer.withdrawal_pending), (PLANNED, true));
    }
    app.charged(&tour, "s1").await;
    app.complete(&tour).await;
    assert_eq!(app.state(&served.id).await, SERVED, "the tour served it all the same");
    assert_eq!(app.state(&left.id).await, WITHDRAWN, "not open again");
    assert!(app.drive("A").await.stops.is_empty());
}

#[tokio::test]
async fn a_newer_request_supersedes_an_open_one() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (older, newer) = (app.ask("s1").await, app.ask("s1").await);
    assert_eq!((app.state(&older.id).await, newer.state), (SUPERSEDED, OPEN));
    let tour = app.drive("A").await;
    assert_eq!(tour.stops.len(), 1);
    assert_eq!(tour.stops[0].request_id, newer.id);
}

#[tokio::test]
async fn a_newer_request_of_a_planned_sensor_waits_for_the_next_departure() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let planned = app.ask("s1").await;
    let tour = app.drive("A").await;
    let newer = app.ask("s1").await;
    assert_eq!((newer.state, app.state(&planned.id).await), (OPEN, PLANNED));
    // The visit came before the newer request was made, as far as is known from its times.
    let early = ReportVisitRequest {
        arrived_at: planned.received_at,
        departed_at: planned.received_at,
        ..field::visit(&tour.id, "s1", VisitOutcome::Failed)
    };
    app.tours().report_visit(early).await.unwrap();
    assert_eq!(app.state(&newer.id).await, OPEN);
    app.complete(&tour).await;
    assert_eq!(app.state(&planned.id).await, SUPERSEDED, "only the newer one can be open");
    let next = app.drive("A").await;
    assert_eq!(next.stops[0].request_id, newer.id);
}

#[tokio::test]
async fn a_visit_serves_the_newer_request_too() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let planned = app.ask("s1").await;
    let tour = app.drive("A").await;
    let newer = app.ask("s1").await;
    let mut served = app.charged(&tour, "s1").await.served_request_ids;
    served.sort();
    assert_eq!(served, [planned.id.clone(), newer.id.clone()]);
    assert_eq!(app.state(&planned.id).await, SERVED);
    assert_eq!(app.state(&newer.id).await, SERVED);
}

#[tokio::test]
async fn a_visit_before_the_newer_request_leaves_that_open() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let planned = app.ask("s1").await;
    let tour = app.drive("A").await;
    let visited_at = from_now(0);
    let newer = app.ask("s1").await;
    let visit = ReportVisitRequest {
        arrived_at: visited_at,
        departed_at: visited_at,
        ..field::visit(&tour.id, "s1", VisitOutcome::Charged)
    };
    let visit = app.tours().report_visit(visit).await.unwrap().into_inner();
    assert_eq!(visit.served_request_ids, [planned.id.as_str()]);
    assert_eq!((app.state(&planned.id).await, app.state(&newer.id).await), (SERVED, OPEN));
}

#[tokio::test]
async fn a_visit_serves_an_open_request_of_a_sensor_that_is_no_stop() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let tour = app.drive("A").await;
    let asked = app.ask("s2").await;
    let visit = app.charged(&tour, "s2").await;
    assert_eq!(visit.served_request_ids, [asked.id.as_str()]);
    assert_eq!(app.state(&asked.id).await, SERVED);
}

#[tokio::test]
async fn the_reports_of_a_tour_that_is_over_are_still_stored() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let asked = app.ask("s1").await;
    let tour = app.drive("A").await;
    app.complete(&tour).await;
    assert_eq!(app.state(&asked.id).await, OPEN);
    let visit = app.charged(&tour, "s1").await;
    assert_eq!(visit.served_request_ids, [asked.id.as_str()]);
    assert_eq!(app.state(&asked.id).await, SERVED);
}
