//! Nothing is unbounded: messages, streams, items under way; what goes beyond is refused, and the rest
//! goes on.

use prost::Message;
use tonic::{Code, Status};
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_client::HealthClient;
use tonic_types::StatusExt;
use voltour::proto::{
    AnnounceRequest, GetNetworkRequest, GetNextRequest, PutNetworkRequest, SubmitRequest,
    WatchRequestsRequest,
};

use crate::app::{Settings, TestApp};
use crate::calls::{OPEN, soon};
use crate::field::{FIELD, departure, line, put, request, sensor};
use crate::metrics::{metrics, value};
use crate::time::{from_now, until};

pub fn limited(limits: &str) -> Settings {
    Settings { more: format!("[limits]\n{limits}\n"), ..Settings::default() }
}

/// A refusal for a limit: it names the limit, and says when to try again.
fn exhausted(status: &Status, limit: &str) {
    assert_eq!(status.code(), Code::ResourceExhausted, "{status}");
    let quota = status.get_details_quota_failure().expect("which limit").violations;
    assert_eq!((quota.len(), quota[0].subject.as_str()), (1, limit));
    assert_eq!(quota[0].description, status.message());
    let retry = status.get_details_retry_info().and_then(|retry| retry.retry_delay);
    assert!(retry.is_some_and(|delay| !delay.is_zero()), "{status:?}");
}

#[tokio::test]
async fn a_message_that_is_too_long_is_refused() {
    let app = TestApp::with(limited("message_bytes = 65536")).await;
    app.put(line(1)).await;
    let first = request("s1");
    let long = |bytes: usize| {
        let mut message = SubmitRequest { sensor_id: "x".repeat(60_000), ..first.clone() };
        message.sensor_id = "x".repeat(60_000 + bytes - message.encoded_len());
        assert_eq!(message.encoded_len(), bytes);
        message
    };
    // The longest that fits is read, and refused for what is in it.
    let status = app.requests().submit(long(65_536)).await.unwrap_err();
    assert_eq!(status.code(), Code::InvalidArgument, "{status}");
    let status = app.requests().submit(long(65_537)).await.unwrap_err();
    assert_eq!(status.code(), Code::ResourceExhausted, "{status}");
    let quota = status.get_details_quota_failure().expect("which limit").violations;
    assert_eq!(quota[0].subject, "limits.message_bytes");
    let items = tokio_stream::iter([request("s1"), long(65_537)]);
    let mut answers = app.requests().submit_stream(items).await.unwrap().into_inner();
    assert!(answers.message().await.unwrap().is_some(), "what came before is answered");
    assert_eq!(answers.message().await.unwrap_err().code(), Code::ResourceExhausted);
    let status = app.networks().put(put(line(5_000))).await.unwrap_err();
    assert_eq!(status.code(), Code::ResourceExhausted, "{status}");
    let network = app.json(&format!("/v1/networks/{FIELD}")).await;
    assert_eq!(network["version"], 1, "nothing of it is stored");
}

#[tokio::test]
async fn streams_beyond_the_limit_are_refused_until_one_ends() {
    let app = TestApp::with(limited("streams = 2")).await;
    app.put(line(1)).await;
    let watch = || WatchRequestsRequest { network_id: FIELD.into() };
    let first = app.requests().watch(watch()).await.unwrap();
    let _second = app.requests().watch(watch()).await.unwrap();
    let status = app.requests().watch(watch()).await.unwrap_err();
    exhausted(&status, "limits.streams");
    let status = app.requests().submit_stream(tokio_stream::iter([request("s1")])).await;
    exhausted(&status.unwrap_err(), "limits.streams");
    // Other calls go on.
    assert_eq!(app.ask("s1").await.state, OPEN);
    drop(first);
    crate::time::until("room for another stream", || async {
        app.requests().watch(watch()).await.ok()
    })
    .await;
}

#[tokio::test]
async fn a_stream_longer_than_what_may_be_under_way_is_taken_whole() {
    let limits = "[limits]\nunacknowledged = 3\n";
    let app = TestApp::with(Settings { more: limits.into(), ..Settings::default() }).await;
    app.put(line(100)).await;
    let items: Vec<_> = (1..=100).map(|number| request(&sensor(number).id)).collect();
    let answers = app.requests().submit_stream(tokio_stream::iter(items)).await.unwrap();
    let mut answers = answers.into_inner();
    for position in 0..100 {
        let answer = soon("an answer", answers.message()).await.unwrap().expect("one an item");
        assert_eq!(answer.position, position);
    }
}

#[tokio::test]
async fn nobody_waits_longer_than_the_longest_wait() {
    let limits = "[limits]\nlongest_wait = \"1s\"\n";
    let app = TestApp::with(Settings { more: limits.into(), ..Settings::default() }).await;
    app.put(line(1)).await;
    let far = voltour::proto::AnnounceRequest {
        t0: crate::time::from_now(3_600_000),
        ..crate::field::departure("A")
    };
    app.announce(far).await;
    let next = voltour::proto::GetNextRequest {
        network_id: FIELD.into(),
        charger_id: "A".into(),
        departure_id: String::new(),
    };
    let status = soon("the longest wait", app.tours().get_next(next)).await.unwrap_err();
    assert_eq!(status.code(), Code::DeadlineExceeded, "{status}");
}

fn next(charger: &str) -> GetNextRequest {
    GetNextRequest {
        network_id: FIELD.into(),
        charger_id: charger.into(),
        departure_id: String::new(),
    }
}

#[tokio::test]
async fn whoever_gives_up_waiting_makes_room_for_another() {
    let app = TestApp::with(limited("waits = 1")).await;
    app.put(line(1)).await;
    app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("A") }).await;
    let mut tours = app.tours();
    let waiting = tokio::spawn(async move { tours.get_next(next("A")).await });
    until("the room is taken", || async {
        (value(&metrics(&app).await, "voltour_tour_waits") == Some(1.0)).then_some(())
    })
    .await;
    exhausted(&app.tours().get_next(next("A")).await.unwrap_err(), "limits.waits");
    waiting.abort();
    until("room for another", || async {
        let mut short = tonic::Request::new(next("A"));
        short.set_timeout(std::time::Duration::from_millis(200));
        let status = app.tours().get_next(short).await.unwrap_err();
        (status.code() != Code::ResourceExhausted).then_some(())
    })
    .await;
}

#[tokio::test]
async fn networks_beyond_the_limit_are_refused_and_those_there_go_on() {
    let app = TestApp::with(limited("networks = 2")).await;
    let named =
        |id: &str, sensors| PutNetworkRequest { network_id: id.into(), ..put(line(sensors)) };
    for id in ["one", "two"] {
        app.networks().put(named(id, 1)).await.unwrap();
    }
    exhausted(&app.networks().put(named("three", 1)).await.unwrap_err(), "limits.networks");
    let missing = GetNetworkRequest { network_id: "three".into() };
    assert_eq!(app.networks().get(missing).await.unwrap_err().code(), Code::NotFound);
    let next = app.networks().put(named("two", 2)).await.unwrap().into_inner();
    assert_eq!(next.version, 2, "a version more is no network more");
}

#[tokio::test]
async fn departures_beyond_the_limit_are_refused_until_one_is_over() {
    let app = TestApp::with(limited("departures = 2")).await;
    app.put(line(1)).await;
    let far = |charger: &str| AnnounceRequest { t0: from_now(3_600_000), ..departure(charger) };
    let first = far("A");
    let announced = app.announce(first.clone()).await;
    app.announce(far("B")).await;
    exhausted(&app.departures().announce(far("C")).await.unwrap_err(), "limits.departures");
    assert_eq!(app.announce(first).await.id, announced.id, "what was taken is answered again");
    app.cancel(&announced.id).await;
    app.announce(far("C")).await;
}

#[tokio::test]
async fn calls_beyond_the_limit_are_refused_and_health_is_told_all_the_same() {
    let app = TestApp::with(limited("all_calls = 1")).await;
    app.put(line(1)).await;
    let watch = WatchRequestsRequest { network_id: FIELD.into() };
    let open = app.requests().watch(watch).await.unwrap();
    exhausted(&app.requests().submit(request("s1")).await.unwrap_err(), "limits.all_calls");
    let mut health = HealthClient::new(app.channel());
    health.check(HealthCheckRequest::default()).await.expect("it lives");
    drop(open);
    until("room for another call", || async { app.requests().submit(request("s1")).await.ok() })
        .await;
}

#[tokio::test]
async fn health_watches_take_no_room_of_other_calls_and_have_a_limit_of_their_own() {
    let app = TestApp::with(limited("all_calls = 1")).await;
    app.put(line(1)).await;
    let mut health = HealthClient::new(app.channel());
    let mut watches = Vec::new();
    let refused = loop {
        match health.watch(HealthCheckRequest::default()).await {
            Ok(watch) => watches.push(watch),
            Err(refused) => break refused,
        }
        assert!(watches.len() <= 1_000, "they have no limit");
        assert_eq!(app.ask("s1").await.state, OPEN, "beside {} health watches", watches.len());
    };
    exhausted(&refused, "health watches");
    health.check(HealthCheckRequest::default()).await.expect("it lives");
    drop(watches);
    until("room for another health watch", || async {
        health.clone().watch(HealthCheckRequest::default()).await.ok()
    })
    .await;
}

#[tokio::test]
async fn planning_leaves_a_core_to_the_requests_and_says_so() {
    let mut app = TestApp::start().await;
    assert!(!app.log().contains("planning.threads"), "one thread is never too many");
    app.sigterm().await;
    let config = std::fs::read_to_string(app.config_path()).unwrap();
    let many = config.replace("[planning]\n", "[planning]\nthreads = 64\n");
    std::fs::write(app.config_path(), many).unwrap();
    app.launch().await;
    let cores = std::thread::available_parallelism().unwrap().get();
    if cores <= 64 {
        assert!(
            app.log().contains("planning.threads: one core is left to requests"),
            "{}",
            app.log()
        );
    }
}
