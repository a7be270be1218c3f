//! What a token of one network sees of a service that has two, and how long.

use prost::Message;
use tonic::{Code, Request, Status};
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::{
    Acknowledgement, AnnounceRequest, GetNextRequest, ListNetworksResponse, ListRequestsResponse,
    SubmitRequest, WatchRequestsRequest,
};

use super::{closed, command, get, raw, token};
use crate::app::TestApp;
use crate::calls::{MOMENT, soon};
use crate::field::{FIELD, departure, line, put, request};

const SOUTH: &str = "south";

/// Two networks with a request each.
async fn two_networks() -> TestApp {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let south = voltour::proto::PutNetworkRequest { network_id: SOUTH.into(), ..put(line(2)) };
    app.networks().put(south).await.unwrap();
    app.ask("s1").await;
    app.submit(SubmitRequest { network_id: SOUTH.into(), ..request("s2") }).await;
    app
}

fn with<T>(token: &str, message: T) -> Request<T> {
    let mut call = Request::new(message);
    call.metadata_mut().insert("authorization", format!("Bearer {token}").parse().unwrap());
    call
}

#[tokio::test]
async fn lists_hold_what_is_of_the_tokens_networks() {
    let app = two_networks().await;
    let south = token(&app, "--role operator --network south");
    let both = token(&app, "--role operator --network south --network field");
    closed(&app).await;
    for (token, networks) in [(&south, &[SOUTH][..]), (&both, &[FIELD, SOUTH])] {
        let list = raw::call(app.channel(), "/voltour.v1.NetworkService/List", Some(token), vec![]);
        let list = ListNetworksResponse::decode(&list.await.unwrap().unwrap()[..]).unwrap();
        let ids: Vec<_> = list.networks.iter().map(|network| network.id.as_str()).collect();
        assert_eq!(ids, networks);
        let list = raw::call(app.channel(), "/voltour.v1.RequestService/List", Some(token), vec![]);
        let list = ListRequestsResponse::decode(&list.await.unwrap().unwrap()[..]).unwrap();
        assert_eq!(list.requests.len(), networks.len());
        for (path, rest) in [("/v1/networks", "id"), ("/v1/requests", "network_id")] {
            let page: serde_json::Value =
                get(&app, path, Some(token)).await.json().await.expect("a page");
            let items = page["items"].as_array().unwrap();
            let mut ids: Vec<_> = items.iter().map(|item| item[rest].as_str().unwrap()).collect();
            ids.sort_unstable();
            assert_eq!(ids, networks, "{path}");
        }
    }
}

#[tokio::test]
async fn an_item_of_a_stream_for_another_network_is_refused_and_the_stream_goes_on() {
    let app = two_networks().await;
    let south = token(&app, "--role base_station --network south");
    closed(&app).await;
    let items = ["field", SOUTH, "nowhere"]
        .map(|network| SubmitRequest { network_id: network.into(), ..request("s1") });
    let stream = with(&south, tokio_stream::iter(items));
    let mut answers = app.requests().submit_stream(stream).await.unwrap().into_inner();
    let mut codes = Vec::new();
    while let Some(Acknowledgement { result, .. }) = answers.message().await.unwrap() {
        codes.push(match result.unwrap() {
            Outcome::Request(_) => 0,
            Outcome::Refused(refusal) => refusal.code,
        });
    }
    assert_eq!(codes, [Code::NotFound as i32, 0, Code::NotFound as i32]);
}

#[tokio::test]
async fn a_charger_whose_token_is_revoked_waits_for_no_tour() {
    let app = two_networks().await;
    let hour = AnnounceRequest { t0: crate::time::from_now(3_600_000), ..departure("A") };
    app.announce(hour).await;
    let made = ["create", "A", "--role", "charger", "--network", FIELD, "--charger", "A"];
    let token = String::from_utf8(command(&app, &made).stdout).unwrap();
    closed(&app).await;
    let (network_id, charger_id) = (FIELD.to_owned(), "A".to_owned());
    let next = GetNextRequest { network_id, charger_id, departure_id: String::new() };
    let (mut tours, next) = (app.tours(), with(token.trim(), next));
    let waiting = tokio::spawn(async move { tours.get_next(next).await });
    tokio::time::sleep(MOMENT).await;
    assert!(!waiting.is_finished());
    assert_eq!(command(&app, &["revoke", "A"]).status.code(), Some(0));
    assert_eq!(code(soon("the end of the wait", waiting).await.unwrap()), Code::Unauthenticated);
}

#[tokio::test]
async fn a_stream_ends_when_its_token_is_revoked_and_when_the_first_token_is_made() {
    let app = two_networks().await;
    let watch = || WatchRequestsRequest { network_id: FIELD.into() };
    let mut open = app.requests().watch(watch()).await.unwrap().into_inner();
    soon("the present state", open.message()).await.unwrap();
    let made = command(&app, &["create", "station", "--role", "base_station", "--network", FIELD]);
    let station = String::from_utf8(made.stdout).unwrap();
    let ended = soon("the end of a watch without a token", open.message()).await;
    assert_eq!(code(ended), Code::Unauthenticated);

    let mut watching =
        app.requests().watch(with(station.trim(), watch())).await.unwrap().into_inner();
    soon("the present state", watching.message()).await.unwrap();
    assert_eq!(command(&app, &["revoke", "station"]).status.code(), Some(0));
    let ended = soon("the end of a watch of a revoked token", watching.message()).await;
    assert_eq!(code(ended), Code::Unauthenticated);
    // The last token is revoked, and that opens nothing.
    let refused = app.requests().watch(watch()).await.unwrap_err();
    assert_eq!(refused.code(), Code::Unauthenticated);
}

fn code<T: std::fmt::Debug>(answer: Result<T, Status>) -> Code {
    answer.unwrap_err().code()
}
