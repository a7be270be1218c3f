//! Lists over gRPC: pages without loss or repetition while rows are being added, and their limits.

use std::collections::HashSet;

use tonic::Code;
use voltour::proto::{
    ListDeparturesRequest, ListNetworksRequest, ListRequestsRequest, PutNetworkRequest,
    RequestState,
};

use crate::app::TestApp;
use crate::field::{FIELD, departure, line, put, request, sensor};
use crate::time::from_now;

#[tokio::test]
async fn requests_are_paged_newest_first_while_more_come_in() {
    let app = TestApp::start().await;
    app.put(line(60)).await;
    let mut before = Vec::new();
    for number in 1..=25 {
        before.push(app.ask(&sensor(number).id).await.id);
    }
    before.reverse();
    let mut list = ListRequestsRequest {
        network_id: FIELD.into(),
        page_size: 4,
        ..ListRequestsRequest::default()
    };
    let mut found = Vec::new();
    let mut number = 26;
    loop {
        let page = app.requests().list(list.clone()).await.unwrap().into_inner();
        assert!(page.requests.len() <= 4);
        found.extend(page.requests.into_iter().map(|request| request.id));
        // A newer one on top, and an older one that changes, move nothing.
        app.ask(&sensor(number).id).await;
        app.withdraw(&before[before.len() - (number - 25)]).await;
        number += 1;
        list.page_token = page.next_page_token;
        if list.page_token.is_empty() {
            break;
        }
    }
    assert_eq!(found, before);
}

#[tokio::test]
async fn requests_are_filtered_by_state_and_sensor() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let (old, new, other) = (app.ask("s1").await, app.ask("s1").await, app.ask("s2").await);
    let list = |states: &[RequestState], sensor: &str| ListRequestsRequest {
        network_id: FIELD.into(),
        states: states.iter().map(|&state| state as i32).collect(),
        sensor_id: sensor.into(),
        ..ListRequestsRequest::default()
    };
    use RequestState::{Open, Served, Superseded};
    for (filter, expected) in [
        (list(&[], ""), vec![&other.id, &new.id, &old.id]),
        (list(&[Open], ""), vec![&other.id, &new.id]),
        (list(&[Open], "s1"), vec![&new.id]),
        (list(&[Open, Superseded], "s1"), vec![&new.id, &old.id]),
        (list(&[Served], ""), vec![]),
        (list(&[], "s3"), vec![]),
        (ListRequestsRequest { network_id: "other".into(), ..list(&[], "") }, vec![]),
        (
            ListRequestsRequest { network_id: String::new(), ..list(&[Superseded], "") },
            vec![&old.id],
        ),
    ] {
        let page = app.requests().list(filter.clone()).await.unwrap().into_inner();
        let ids: Vec<_> = page.requests.iter().map(|request| &request.id).collect();
        assert_eq!(ids, expected, "{filter:?}");
    }
}

#[tokio::test]
async fn networks_are_listed_by_id_without_their_sensors() {
    let app = TestApp::start().await;
    for id in ["m", "a", "z", "b:1", "b.1"] {
        let call = PutNetworkRequest { network_id: id.into(), ..put(line(2)) };
        app.networks().put(call).await.unwrap();
    }
    let mut list = ListNetworksRequest { page_size: 2, page_token: String::new() };
    let mut found = Vec::new();
    loop {
        let page = app.networks().list(list.clone()).await.unwrap().into_inner();
        for network in page.networks {
            assert_eq!(network.sensor_count, 2);
            assert!(network.spec.is_none_or(|spec| spec.sensors.is_empty()));
            found.push(network.id);
        }
        list.page_token = page.next_page_token;
        if list.page_token.is_empty() {
            break;
        }
    }
    assert_eq!(found, ["a", "b.1", "b:1", "m", "z"]);
}

#[tokio::test]
async fn departures_are_paged_newest_first() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let mut ids = Vec::new();
    for number in 0..5 {
        let call = voltour::proto::AnnounceRequest {
            t0: from_now(3_600_000 - number * 1000),
            ..departure("A")
        };
        ids.push(app.announce(call).await.id);
    }
    ids.reverse();
    let mut list = ListDeparturesRequest { page_size: 2, ..ListDeparturesRequest::default() };
    let mut found = Vec::new();
    loop {
        let page = app.departures().list(list.clone()).await.unwrap().into_inner();
        found.extend(page.departures.into_iter().map(|departure| departure.id));
        list.page_token = page.next_page_token;
        if list.page_token.is_empty() {
            break;
        }
    }
    assert_eq!(found, ids);
}

#[tokio::test]
async fn a_page_has_fifty_unless_asked_and_never_more_than_500() {
    let app = TestApp::start().await;
    app.put(line(51)).await;
    for number in 1..=51 {
        app.submit(request(&sensor(number).id)).await;
    }
    let list = ListRequestsRequest::default();
    let page = app.requests().list(list.clone()).await.unwrap().into_inner();
    assert_eq!(page.requests.len(), 50);
    let all: HashSet<_> = page.requests.iter().map(|request| &request.id).collect();
    assert_eq!(all.len(), 50);
    let rest = ListRequestsRequest { page_token: page.next_page_token.clone(), ..list.clone() };
    let rest = app.requests().list(rest).await.unwrap().into_inner();
    assert_eq!((rest.requests.len(), rest.next_page_token.as_str()), (1, ""));
    let large = ListRequestsRequest { page_size: 500, ..list.clone() };
    let large = app.requests().list(large).await.unwrap().into_inner();
    assert_eq!((large.requests.len(), large.next_page_token.as_str()), (51, ""));
    let beyond = ListRequestsRequest { page_size: 501, ..list };
    let refused = app.requests().list(beyond).await.unwrap_err();
    assert_eq!(refused.code(), Code::InvalidArgument);
}
