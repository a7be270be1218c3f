//! Nothing is unbounded: messages, streams, items under way; what goes beyond is refused, and the rest
//! goes on.

use tonic::Code;
use voltour::proto::WatchRequestsRequest;

use crate::app::{Settings, TestApp};
use crate::calls::{OPEN, soon};
use crate::field::{FIELD, line, put, request, sensor};

#[tokio::test]
async fn a_message_that_is_too_long_is_refused() {
    let limits = "[limits]\nmessage_bytes = 65536\n";
    let app = TestApp::with(Settings { more: limits.into(), ..Settings::default() }).await;
    let status = app.networks().put(put(line(5000))).await.unwrap_err();
    let refused = matches!(status.code(), Code::OutOfRange | Code::ResourceExhausted);
    assert!(refused, "{status}");
    app.put(line(5)).await;
}

#[tokio::test]
async fn streams_beyond_the_limit_are_refused_until_one_ends() {
    let limits = "[limits]\nstreams = 2\n";
    let app = TestApp::with(Settings { more: limits.into(), ..Settings::default() }).await;
    app.put(line(1)).await;
    let watch = || WatchRequestsRequest { network_id: FIELD.into() };
    let first = app.requests().watch(watch()).await.unwrap();
    let _second = app.requests().watch(watch()).await.unwrap();
    let status = app.requests().watch(watch()).await.unwrap_err();
    assert_eq!(status.code(), Code::ResourceExhausted, "{status}");
    let status = app.requests().submit_stream(tokio_stream::iter([request("s1")])).await;
    assert_eq!(status.unwrap_err().code(), Code::ResourceExhausted);
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
