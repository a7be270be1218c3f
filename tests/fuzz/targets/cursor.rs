//! The cursor of a list, which gRPC calls a page token: both edges take the same ones, and neither breaks over one.

use std::str::from_utf8;

use reqwest::StatusCode;
use tonic::Code;
use voltour::proto::departure_service_client::DepartureServiceClient;
use voltour::proto::network_service_client::NetworkServiceClient;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::{ListDeparturesRequest, ListNetworksRequest, ListRequestsRequest};

use super::service::Service;

pub fn cursor(data: &[u8]) -> bool {
    // An empty one is none, and REST knows it from one that is left out.
    let Some(token) = from_utf8(data).ok().filter(|token| !token.is_empty()) else { return false };
    let running = Service::running();
    running.wait(async {
        let mut is_any = false;
        for list in ["networks", "requests", "departures"] {
            let (rest, grpc) = (rest(running, list, token).await, grpc(running, list, token).await);
            assert_eq!(rest, grpc, "{list}: {token:?} by REST, by gRPC");
            is_any |= rest;
        }
        is_any
    })
}

async fn rest(running: &Service, list: &str, token: &str) -> bool {
    let mut address: reqwest::Url =
        format!("{}/v1/{list}", running.rest).parse().expect("an address");
    address.query_pairs_mut().append_pair("cursor", token);
    let status = running.client.get(address).send().await.expect("an answer").status();
    match status {
        StatusCode::OK => true,
        StatusCode::BAD_REQUEST | StatusCode::URI_TOO_LONG => false,
        _ => panic!("{list}: {token:?}: {status}"),
    }
}

async fn grpc(running: &Service, list: &str, token: &str) -> bool {
    let (channel, page_token) = (running.channel.clone(), token.to_owned());
    let listed = match list {
        "networks" => {
            let ask = ListNetworksRequest { page_token, ..ListNetworksRequest::default() };
            NetworkServiceClient::new(channel).list(ask).await.map(drop)
        }
        "requests" => {
            let ask = ListRequestsRequest { page_token, ..ListRequestsRequest::default() };
            RequestServiceClient::new(channel).list(ask).await.map(drop)
        }
        _ => {
            let ask = ListDeparturesRequest { page_token, ..ListDeparturesRequest::default() };
            DepartureServiceClient::new(channel).list(ask).await.map(drop)
        }
    };
    match listed {
        Ok(()) => true,
        Err(status) if status.code() == Code::InvalidArgument => false,
        Err(status) => panic!("{list}: {token:?}: {status}"),
    }
}
