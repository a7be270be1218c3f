//! SubmitStream: one acknowledgement each, in order; a bad item gets its own, and the stream goes on.

use std::collections::HashSet;

use tonic::{Code, Streaming};
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::{Acknowledgement, ListRequestsRequest, RequestState, SubmitRequest};

use crate::app::TestApp;
use crate::calls::{OPEN, soon};
use crate::field::{FIELD, line, request, sensor};
use crate::time::from_now;

/// Sends all, however fast they are taken, and waits for all answers.
async fn send_all(app: &TestApp, items: Vec<SubmitRequest>) -> Vec<Acknowledgement> {
    let stream = tokio_stream::iter(items);
    let mut answers: Streaming<Acknowledgement> =
        soon("SubmitStream", app.requests().submit_stream(stream)).await.unwrap().into_inner();
    let mut all = Vec::new();
    while let Some(answer) = soon("an answer", answers.message()).await.expect("no failure") {
        all.push(answer);
    }
    all
}

#[tokio::test]
async fn five_thousand_are_acknowledged_in_order_and_stored() {
    const SENSORS: usize = 5000;
    let mut app = TestApp::start().await;
    app.put(line(SENSORS)).await;
    let items: Vec<_> = (1..=SENSORS).map(|n| request(&sensor(n).id)).collect();
    let answers = send_all(&app, items.clone()).await;
    assert_eq!(answers.len(), SENSORS);
    let mut ids = HashSet::new();
    for (i, (item, answer)) in items.iter().zip(&answers).enumerate() {
        assert_eq!((answer.position, &answer.client_id), (i as u64, &item.client_id));
        let Some(Outcome::Request(stored)) = &answer.result else { panic!("{answer:?}") };
        assert_eq!((stored.submitted.as_ref(), stored.state), (Some(item), OPEN));
        ids.insert(stored.id.clone());
    }
    assert_eq!(ids.len(), SENSORS);
    // What was acknowledged outlives the process.
    app.restart().await;
    let mut found = HashSet::new();
    let mut list = ListRequestsRequest {
        network_id: FIELD.into(),
        states: vec![RequestState::Open as i32],
        page_size: 500,
        ..ListRequestsRequest::default()
    };
    loop {
        let page = app.requests().list(list.clone()).await.unwrap().into_inner();
        found.extend(page.requests.into_iter().map(|request| request.id));
        list.page_token = page.next_page_token;
        if list.page_token.is_empty() {
            break;
        }
    }
    assert_eq!(found, ids);
}

#[tokio::test]
async fn a_bad_item_is_refused_alone() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let good = request("s1");
    let items = vec![
        good.clone(),
        SubmitRequest { residual_j: Some(-5.0), ..request("s2") },
        SubmitRequest { network_id: "nowhere".into(), ..request("s2") },
        SubmitRequest { client_id: "no spaces, please".into(), ..request("s2") },
        // The first one's id with other content, then again as it was.
        SubmitRequest { deadline: from_now(60_000), ..good.clone() },
        good.clone(),
        request("s3"),
    ];
    let answers = send_all(&app, items.clone()).await;
    assert_eq!(answers.len(), items.len());
    let refused = |i: usize| match &answers[i].result {
        Some(Outcome::Refused(refusal)) => refusal,
        other => panic!("item {i}: {other:?}"),
    };
    let stored = |i: usize| match &answers[i].result {
        Some(Outcome::Request(request)) => request,
        other => panic!("item {i}: {other:?}"),
    };
    for (i, code, fields) in [
        (1, Code::InvalidArgument, vec!["residual_j"]),
        (2, Code::NotFound, vec![]),
        (3, Code::InvalidArgument, vec!["client_id"]),
        (4, Code::AlreadyExists, vec![]),
    ] {
        let refusal = refused(i);
        assert_eq!(refusal.code, code as i32, "item {i}: {refusal:?}");
        let named: Vec<_> = refusal.field_violations.iter().map(|v| v.field.as_str()).collect();
        assert_eq!(named, fields, "item {i}");
        assert!(!refusal.message.is_empty());
    }
    assert_eq!(stored(5).id, stored(0).id, "the same call gets the same answer");
    assert_eq!(stored(6).submitted.as_ref(), Some(&items[6]));
    let positions: Vec<u64> = answers.iter().map(|answer| answer.position).collect();
    assert_eq!(positions, [0, 1, 2, 3, 4, 5, 6]);
    // Nothing of a refused item is stored.
    let listed = app.requests().list(ListRequestsRequest::default()).await.unwrap().into_inner();
    assert_eq!(listed.requests.len(), 2);
}

#[tokio::test]
async fn items_are_acknowledged_while_the_stream_is_open() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let (send, items) = tokio::sync::mpsc::channel(1);
    let stream = tokio_stream::wrappers::ReceiverStream::new(items);
    let mut requests = app.requests();
    let call = requests.submit_stream(stream);
    let mut answers = soon("SubmitStream", call).await.unwrap().into_inner();
    for (position, sensor) in [(0, "s1"), (1, "s2"), (2, "s1")] {
        send.send(request(sensor)).await.unwrap();
        let answer = soon("an answer", answers.message()).await.unwrap().unwrap();
        assert_eq!(answer.position, position);
    }
    drop(send);
    assert!(soon("the end", answers.message()).await.unwrap().is_none());
}

#[tokio::test]
async fn an_empty_stream_is_answered_by_an_empty_one() {
    let app = TestApp::start().await;
    assert!(send_all(&app, Vec::new()).await.is_empty());
}
