//! The same client id with the same content gets the same answer and stores nothing; with other
//! content it gets ALREADY_EXISTS. For every call that changes something, also after a crash.

use tonic::{Code, Status};
use voltour::proto::{
    AnnounceRequest, CancelDepartureRequest, CompleteRequest, PutNetworkRequest,
    ReportVisitRequest, SensorTrajectory, SubmitRequest, Trajectory, UpdateTrajectoryRequest,
    VisitOutcome, Waypoint, WithdrawRequest,
};

use crate::app::TestApp;
use crate::calls::{PLANNED, SUPERSEDED, WITHDRAWN};
use crate::field::{
    self, FIELD, cancellation, completion, departure, fresh, line, point, put, request, withdrawal,
};
use crate::time::{from_now, now_us, wire};

#[track_caller]
fn already_exists<T: std::fmt::Debug>(answer: Result<T, Status>) {
    assert_eq!(answer.expect_err("other content").code(), Code::AlreadyExists);
}

#[tokio::test]
async fn put_twice() {
    let mut app = TestApp::start().await;
    let call = PutNetworkRequest { expected_version: Some(0), ..put(line(2)) };
    let first = app.networks().put(call.clone()).await.unwrap().into_inner();
    app.put(line(3)).await;
    app.restart().await;
    let again = app.networks().put(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first, "the answer of then, though there is a newer version");
    let now = app.networks().get(get_network()).await.unwrap().into_inner();
    assert_eq!((now.version, now.sensor_count), (2, 3));
    already_exists(app.networks().put(PutNetworkRequest { spec: Some(line(4)), ..call }).await);
}

fn get_network() -> voltour::proto::GetNetworkRequest {
    voltour::proto::GetNetworkRequest { network_id: FIELD.into() }
}

#[tokio::test]
async fn update_trajectory_twice() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let to = |x_m| SensorTrajectory {
        sensor_id: "s1".into(),
        trajectory: Some(Trajectory {
            waypoints: vec![Waypoint { time: Some(wire(1_000_000)), position_m: point(x_m, 0.0) }],
        }),
    };
    let call = UpdateTrajectoryRequest {
        client_id: fresh("move"),
        network_id: FIELD.into(),
        trajectories: vec![to(1.0)],
    };
    let first = app.networks().update_trajectory(call.clone()).await.unwrap().into_inner();
    assert_eq!(first.updated, 1);
    let newer = UpdateTrajectoryRequest {
        client_id: fresh("move"),
        trajectories: vec![to(2.0)],
        ..call.clone()
    };
    app.networks().update_trajectory(newer).await.unwrap();
    let again = app.networks().update_trajectory(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first);
    already_exists(
        app.networks()
            .update_trajectory(UpdateTrajectoryRequest { trajectories: vec![to(3.0)], ..call })
            .await,
    );
    app.ask("s1").await;
    let scenario = app.scenario(&app.drive("A").await).await;
    let rows = &scenario["sensors"][0]["trajectory"];
    assert_eq!(rows[0][1], 2.0, "the repeated call moved nothing back: {rows}");
}

#[tokio::test]
async fn submit_twice() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    let call = SubmitRequest { deadline: from_now(600_000), ..request("s1") };
    let first = app.submit(call.clone()).await;
    assert_eq!(app.submit(call.clone()).await, first);
    app.restart().await;
    assert_eq!(app.submit(call.clone()).await, first);
    let refused = SubmitRequest { required: true, ..call.clone() };
    already_exists(app.requests().submit(refused).await);
    already_exists(
        app.requests().submit(SubmitRequest { sensor_id: "s2".into(), ..call.clone() }).await,
    );
    // A repeated call is not a newer request.
    let newer = app.ask("s1").await;
    let again = app.submit(call).await;
    assert_eq!((again.id, again.state), (first.id, SUPERSEDED));
    assert_eq!(app.drive("A").await.stops[0].request_id, newer.id);
}

#[tokio::test]
async fn the_ids_of_networks_are_their_own() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let other = PutNetworkRequest { network_id: "other".into(), ..put(line(1)) };
    app.networks().put(other).await.unwrap();
    let call = request("s1");
    let here = app.submit(call.clone()).await;
    let there = app.submit(SubmitRequest { network_id: "other".into(), ..call }).await;
    assert_ne!(here.id, there.id);
}

#[tokio::test]
async fn withdraw_twice() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    let (one, two) = (app.ask("s1").await, app.ask("s2").await);
    let call = withdrawal(&one.id);
    let first = app.requests().withdraw(call.clone()).await.unwrap().into_inner();
    assert_eq!(first.state, WITHDRAWN);
    app.restart().await;
    let again = app.requests().withdraw(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first);
    already_exists(app.requests().withdraw(WithdrawRequest { request_id: two.id, ..call }).await);
}

#[tokio::test]
async fn announce_twice() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    let call = AnnounceRequest {
        t0: Some(wire(now_us() + 3_600_000_000)),
        capacity_j: Some(1000.0),
        ..departure("A")
    };
    let first = app.announce(call.clone()).await;
    app.restart().await;
    assert_eq!(app.announce(call.clone()).await, first);
    already_exists(
        app.departures().announce(AnnounceRequest { capacity_j: None, ..call.clone() }).await,
    );
    already_exists(app.departures().announce(AnnounceRequest { t0: None, ..call }).await);
    // A t0 that was left out is chosen once.
    let soon = departure("B");
    let chosen = app.announce(soon.clone()).await;
    app.tour(&chosen).await;
    let again = app.announce(soon).await;
    assert_eq!((again.id, again.t0), (chosen.id, chosen.t0));
    let all = voltour::proto::ListDeparturesRequest::default();
    assert_eq!(app.departures().list(all).await.unwrap().into_inner().departures.len(), 2);
}

#[tokio::test]
async fn an_announcement_may_be_repeated_when_its_t0_is_long_over() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let call = AnnounceRequest { t0: from_now(-29_000), ..departure("A") };
    let first = app.announce(call.clone()).await;
    crate::time::pause(1500).await;
    assert_eq!(app.announce(call).await.id, first.id);
}

#[tokio::test]
async fn cancel_twice() {
    let mut app = TestApp::start().await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let tour = app.drive("A").await;
    let call = cancellation(&tour.departure_id);
    let first = app.departures().cancel(call.clone()).await.unwrap().into_inner();
    app.restart().await;
    let next = app.drive("A").await;
    let again = app.departures().cancel(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first);
    assert_eq!(app.state(&asked.id).await, PLANNED, "the repeated call opened nothing");
    already_exists(
        app.departures()
            .cancel(CancelDepartureRequest { reason: "another".into(), ..call.clone() })
            .await,
    );
    // The ids of departures are their own.
    let other = CancelDepartureRequest { departure_id: next.departure_id, ..call };
    app.departures().cancel(other).await.unwrap();
}

#[tokio::test]
async fn report_visit_twice() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    let call = ReportVisitRequest {
        charge_j: Some(99.0),
        ..field::visit(&tour.id, "s1", VisitOutcome::Charged)
    };
    let first = app.tours().report_visit(call.clone()).await.unwrap().into_inner();
    let newer = app.ask("s1").await;
    app.restart().await;
    let again = app.tours().report_visit(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first);
    assert_eq!(app.state(&newer.id).await, crate::calls::OPEN, "the repeated call served nothing");
    already_exists(
        app.tours().report_visit(ReportVisitRequest { charge_j: Some(98.0), ..call }).await,
    );
}

#[tokio::test]
async fn complete_twice() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    let asked = app.ask("s1").await;
    let tour = app.drive("A").await;
    let call = completion(&tour.id);
    let first = app.tours().complete(call.clone()).await.unwrap().into_inner();
    app.restart().await;
    let next = app.drive("A").await;
    let again = app.tours().complete(call.clone()).await.unwrap().into_inner();
    assert_eq!(again, first);
    assert_eq!(app.state(&asked.id).await, PLANNED, "the repeated call opened nothing");
    // The ids of tours are their own, and a tour is all that the call says.
    let other = CompleteRequest { tour_id: next.id, ..call };
    app.tours().complete(other).await.unwrap();
}

#[tokio::test]
async fn a_refused_call_uses_its_id_up_for_nothing() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let bad = SubmitRequest { residual_j: Some(-1.0), ..request("s1") };
    app.requests().submit(bad.clone()).await.unwrap_err();
    app.submit(SubmitRequest { residual_j: Some(1.0), ..bad }).await;
    let bad = PutNetworkRequest { expected_version: Some(9), ..put(line(2)) };
    let refused = app.networks().put(bad.clone()).await.unwrap_err();
    assert_eq!(refused.code(), Code::Aborted);
    app.networks().put(PutNetworkRequest { expected_version: Some(1), ..bad }).await.unwrap();
}
