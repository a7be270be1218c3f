//! Of the lists: sizes, tokens and filters.

use voltour::proto::{ListDeparturesRequest, ListNetworksRequest, ListRequestsRequest};

use super::refused;
use crate::app::TestApp;
use crate::field::line;

#[tokio::test]
async fn sizes_and_tokens_that_are_none() {
    let app = TestApp::start().await;
    let networks = |page_size, page_token: &str| ListNetworksRequest {
        page_size,
        page_token: page_token.into(),
    };
    let requests = |page_size, page_token: &str| ListRequestsRequest {
        page_size,
        page_token: page_token.into(),
        ..ListRequestsRequest::default()
    };
    let departures = |page_size, page_token: &str| ListDeparturesRequest {
        page_size,
        page_token: page_token.into(),
        ..ListDeparturesRequest::default()
    };
    for size in [501, u32::MAX] {
        refused(app.networks().list(networks(size, "")).await, "page_size");
        refused(app.requests().list(requests(size, "")).await, "page_size");
        refused(app.departures().list(departures(size, "")).await, "page_size");
    }
    for token in ["!", "bm9ydGg=", "' OR 1=1 --", &"A".repeat(5000)] {
        refused(app.networks().list(networks(1, token)).await, "page_token");
        refused(app.requests().list(requests(1, token)).await, "page_token");
        refused(app.departures().list(departures(1, token)).await, "page_token");
    }
}

#[tokio::test]
async fn filters_that_name_nothing() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let r = ListRequestsRequest::default;
    let d = ListDeparturesRequest::default;
    for (field, call) in [
        ("states[1]", ListRequestsRequest { states: vec![1, 99], ..r() }),
        ("states[0]", ListRequestsRequest { states: vec![0], ..r() }),
        ("network_id", ListRequestsRequest { network_id: "no network".into(), ..r() }),
        ("sensor_id", ListRequestsRequest { sensor_id: "x".repeat(129), ..r() }),
    ] {
        refused(app.requests().list(call).await, field);
    }
    for (field, call) in [
        ("states[0]", ListDeparturesRequest { states: vec![-1], ..d() }),
        ("network_id", ListDeparturesRequest { network_id: "no network".into(), ..d() }),
        ("charger_id", ListDeparturesRequest { charger_id: "no charger".into(), ..d() }),
    ] {
        refused(app.departures().list(call).await, field);
    }
}
