//! Of RequestService; the items of SubmitStream obey the same rules.

use tonic::Code;
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::{
    GetRequestRequest, ListRequestsRequest, Place, Point, SubmitRequest, WithdrawRequest, place,
};

use super::{NO_NUMBERS, bad_ids, refused};
use crate::app::TestApp;
use crate::calls::soon;
use crate::field::{at_rest, line, request, withdrawal};
use crate::time::from_now;

/// Requests with one bad field each.
fn bad_requests() -> Vec<(&'static str, SubmitRequest)> {
    let r = || request("s1");
    let time = |seconds, nanos| Some(prost_types::Timestamp { seconds, nanos });
    let mut all = vec![
        ("sensor_id", SubmitRequest { sensor_id: String::new(), ..r() }),
        ("sensor_id", SubmitRequest { sensor_id: "x".repeat(129), ..r() }),
        ("sensor_id", SubmitRequest { sensor_id: "unknown".into(), ..r() }),
        ("place", SubmitRequest { place: Some(Place { place: None }), ..r() }),
        ("place.trajectory.waypoints", SubmitRequest { place: still(), ..r() }),
        ("residual_j", SubmitRequest { residual_j: Some(-0.5), ..r() }),
        // More than the battery holds.
        ("residual_j", SubmitRequest { residual_j: Some(100.5), ..r() }),
        ("drain_w", SubmitRequest { drain_w: Some(-1.0), ..r() }),
        ("reward", SubmitRequest { reward: Some(-1.0), ..r() }),
        ("ready", SubmitRequest { ready: from_now(9000), deadline: from_now(8000), ..r() }),
        ("deadline.nanos", SubmitRequest { deadline: time(2_000_000_000, -1), ..r() }),
        ("deadline.nanos", SubmitRequest { deadline: time(2_000_000_000, 1_000_000_000), ..r() }),
        ("deadline.seconds", SubmitRequest { deadline: time(i64::MAX, 0), ..r() }),
        ("ready.seconds", SubmitRequest { ready: time(i64::MIN, 0), ..r() }),
        (
            "measured_at",
            SubmitRequest { residual_j: Some(1.0), measured_at: from_now(3_600_000), ..r() },
        ),
    ];
    for value in NO_NUMBERS {
        all.extend([
            ("residual_j", SubmitRequest { residual_j: Some(value), ..r() }),
            ("drain_w", SubmitRequest { drain_w: Some(value), ..r() }),
            ("reward", SubmitRequest { reward: Some(value), ..r() }),
            ("place.position_m.y_m", SubmitRequest { place: at_rest(0.0, value), ..r() }),
        ]);
    }
    for id in bad_ids() {
        all.push(("client_id", SubmitRequest { client_id: id.clone(), ..r() }));
        all.push(("network_id", SubmitRequest { network_id: id, ..r() }));
    }
    all
}

fn still() -> Option<Place> {
    let trajectory = voltour::proto::Trajectory { waypoints: Vec::new() };
    Some(Place { place: Some(place::Place::Trajectory(trajectory)) })
}

#[tokio::test]
async fn submit_names_the_field() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    for (field, call) in bad_requests() {
        refused(app.requests().submit(call).await, field);
    }
    let elsewhere = SubmitRequest { network_id: "nowhere".into(), ..request("s1") };
    let status = app.requests().submit(elsewhere).await.unwrap_err();
    assert_eq!(status.code(), Code::NotFound, "{status}");
    let all = app.requests().list(ListRequestsRequest::default()).await.unwrap().into_inner();
    assert!(all.requests.is_empty(), "nothing of a refused call is stored");
}

#[tokio::test]
async fn every_bad_item_of_a_stream_names_the_field() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (fields, items): (Vec<_>, Vec<_>) = bad_requests().into_iter().unzip();
    let answers = app.requests().submit_stream(tokio_stream::iter(items)).await.unwrap();
    let mut answers = answers.into_inner();
    for field in fields {
        let answer = soon("an answer", answers.message()).await.unwrap().expect("one an item");
        let Some(Outcome::Refused(refusal)) = answer.result else { panic!("accepted: {field}") };
        assert_eq!(refusal.code, Code::InvalidArgument as i32);
        let named: Vec<_> = refusal.field_violations.iter().map(|v| v.field.as_str()).collect();
        assert_eq!(named, [field], "{}", refusal.message);
    }
    assert!(soon("the end", answers.message()).await.unwrap().is_none());
}

#[tokio::test]
async fn a_request_may_not_move_its_sensor_under_a_coverage_constraint() {
    let app = TestApp::start().await;
    app.put(crate::field::covered(2, 1)).await;
    let waypoint = voltour::proto::Waypoint {
        time: from_now(0),
        position_m: Some(Point { x_m: 1.0, y_m: 1.0 }),
    };
    let trajectory = voltour::proto::Trajectory { waypoints: vec![waypoint] };
    let place = Some(Place { place: Some(place::Place::Trajectory(trajectory)) });
    let status = app.requests().submit(SubmitRequest { place, ..request("s1") }).await.unwrap_err();
    let named = super::violations(&status);
    assert!(named.len() == 1 && named[0].starts_with("place"), "{named:?}");
}

#[tokio::test]
async fn withdraw_and_get_name_the_field() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let asked = app.ask("s1").await;
    let fine = withdrawal(&asked.id);
    for id in ["", "1", "not-a-uuid", "0190163d8694739b8ca7c9f6e6a7b0a1"] {
        let call = WithdrawRequest { request_id: id.into(), ..fine.clone() };
        refused(app.requests().withdraw(call).await, "request_id");
        let get = GetRequestRequest { request_id: id.into() };
        refused(app.requests().get(get).await, "request_id");
    }
    for id in bad_ids() {
        let call = WithdrawRequest { client_id: id.clone(), ..fine.clone() };
        refused(app.requests().withdraw(call).await, "client_id");
        let call = WithdrawRequest { network_id: id, ..fine.clone() };
        refused(app.requests().withdraw(call).await, "network_id");
    }
    let unknown = "0190163d-8694-739b-8ca7-c9f6e6a7b0a1";
    let call = WithdrawRequest { request_id: unknown.into(), ..fine.clone() };
    assert_eq!(app.requests().withdraw(call).await.unwrap_err().code(), Code::NotFound);
    let get = GetRequestRequest { request_id: unknown.into() };
    assert_eq!(app.requests().get(get).await.unwrap_err().code(), Code::NotFound);
    // Another network's request is none of this one's.
    let call = WithdrawRequest { network_id: "other".into(), ..fine };
    assert_eq!(app.requests().withdraw(call).await.unwrap_err().code(), Code::NotFound);
    assert_eq!(app.state(&asked.id).await, crate::calls::OPEN);
}
