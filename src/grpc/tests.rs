//! The edge over a real connection, with a real store.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use tonic::transport::{Channel, Endpoint};
use tonic::{Code, Request};

use super::{Edge, Server, ServerError, violations};
use crate::access::Gate;
use crate::clock::SystemClock;
use crate::config::Config;
use crate::listen::Counted;
use crate::metrics::Metrics;
use crate::policy::{Policies, Shelf};
use crate::proto::acknowledgement::Result as Outcome;
use crate::proto::network_service_client::NetworkServiceClient;
use crate::proto::request_service_client::RequestServiceClient;
use crate::proto::tour_service_client::TourServiceClient;
use crate::proto::{
    ChargerType, GetNextRequest, NetworkSpec, Objective, Place, Point, PutNetworkRequest,
    RequestState, Sensor, SubmitRequest, WatchRequestsRequest, place,
};
use crate::scheduler::{self, Running};
use crate::store::Store;

struct Service {
    channel: Channel,
    stop: CancellationToken,
    scheduler: CancellationToken,
    server: JoinHandle<Result<(), ServerError>>,
    running: Running,
}

impl Service {
    async fn start(directory: &Path) -> Self {
        let clock = Arc::new(SystemClock);
        let store = Store::open(&directory.join("test.db"), clock.clone()).await.unwrap();
        let (stop, scheduler) = (CancellationToken::new(), CancellationToken::new());
        let config = Config::default();
        let (settings, policies) = (config.settings(), Shelf::of(Policies::none()));
        let (handle, running) = scheduler::start(
            store,
            clock,
            settings,
            policies,
            Metrics::default(),
            scheduler.clone(),
        )
        .await
        .unwrap();
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = format!("http://{}", listener.local_addr().unwrap());
        let gate = Gate::open(handle.reads().clone(), None).await.unwrap();
        let calls = Metrics::default().calls;
        let open = calls.connections("grpc");
        let edge = Edge::new(handle, gate, config.grpc_limits(), calls, stop.clone());
        let server = tokio::spawn(
            Server::new(edge, Counted::new(listener, 100, Duration::from_secs(30), open, None))
                .run(),
        );
        let channel = Endpoint::from_shared(address).unwrap().connect().await.unwrap();
        let service = Self { channel, stop, scheduler, server, running };
        NetworkServiceClient::new(service.channel.clone()).put(network(700)).await.unwrap();
        service
    }

    async fn end(self) {
        self.stop.cancel();
        self.server.await.unwrap().unwrap();
        self.scheduler.cancel();
        self.running.finished().await.unwrap();
    }
}

fn network(sensors: usize) -> PutNetworkRequest {
    let at = Point { x_m: 1.0, y_m: 2.0 };
    let sensor = |i| Sensor {
        id: format!("s{i}"),
        place: Some(Place { place: Some(place::Place::PositionM(at)) }),
        battery_j: 100.0,
        ..Sensor::default()
    };
    let truck = ChargerType {
        name: "truck".to_owned(),
        speed_mps: 1.0,
        transfer_w: 1.0,
        start_m: Some(at),
        ..ChargerType::default()
    };
    let spec = NetworkSpec {
        objective: Objective::MaxCount.into(),
        charger_types: vec![truck],
        sensors: (0..sensors).map(sensor).collect(),
        ..NetworkSpec::default()
    };
    PutNetworkRequest {
        client_id: "put".to_owned(),
        network_id: "north".to_owned(),
        spec: Some(spec),
        expected_version: None,
    }
}

fn submit(i: usize) -> SubmitRequest {
    SubmitRequest {
        client_id: format!("c{i}"),
        network_id: "north".to_owned(),
        sensor_id: format!("s{i}"),
        ..SubmitRequest::default()
    }
}

#[tokio::test]
async fn acknowledgements_come_in_order_and_a_bad_item_does_not_end_the_stream() {
    let directory = tempfile::tempdir().unwrap();
    let service = Service::start(directory.path()).await;
    let mut items: Vec<SubmitRequest> = (0..600).map(submit).collect();
    items[7].reward = Some(-1.0);
    items[8].sensor_id = "nobody".to_owned();
    let mut client = RequestServiceClient::new(service.channel.clone());
    let answers = client.submit_stream(tokio_stream::iter(items)).await.unwrap();
    let mut answers = answers.into_inner();
    let mut last = String::new();
    for position in 0..600 {
        let answer = answers.message().await.unwrap().unwrap();
        assert_eq!((answer.position, answer.client_id), (position, format!("c{position}")));
        match answer.result.unwrap() {
            Outcome::Request(request) => {
                assert_eq!(request.state(), RequestState::Open);
                // Stored in order, too: their ids are made when they are.
                assert!(request.id > last, "{position}");
                last = request.id;
            }
            Outcome::Refused(refusal) => {
                let field = refusal.field_violations[0].field.clone();
                let expected = [(7, "reward"), (8, "sensor_id")];
                assert!(expected.contains(&(position, field.as_str())), "{position} {field}");
            }
        }
    }
    assert!(answers.message().await.unwrap().is_none());
    service.end().await;
}

#[tokio::test]
async fn a_watch_sends_what_is_there_then_every_change_then_that_the_service_stops() {
    let directory = tempfile::tempdir().unwrap();
    let service = Service::start(directory.path()).await;
    let mut client = RequestServiceClient::new(service.channel.clone());
    client.submit(submit(0)).await.unwrap();
    let watched = WatchRequestsRequest { network_id: "north".to_owned() };
    let mut changes = client.watch(watched).await.unwrap().into_inner();
    let first = changes.message().await.unwrap().unwrap();
    assert!(first.initial);
    // More than a page at once.
    let items = tokio_stream::iter((1..700).map(submit));
    let mut answers = client.submit_stream(items).await.unwrap().into_inner();
    while answers.message().await.unwrap().is_some() {}
    let mut last = first.change;
    for _ in 1..700 {
        let next = changes.message().await.unwrap().unwrap();
        assert!(!next.initial && next.change > last, "{last} {next:?}");
        last = next.change;
    }
    service.stop.cancel();
    assert_eq!(changes.message().await.unwrap_err().code(), Code::Unavailable);
    service.end().await;
}

#[tokio::test]
async fn a_network_that_nobody_has_put_cannot_be_watched() {
    let directory = tempfile::tempdir().unwrap();
    let service = Service::start(directory.path()).await;
    let mut client = RequestServiceClient::new(service.channel.clone());
    let watched = WatchRequestsRequest { network_id: "south".to_owned() };
    assert_eq!(client.watch(watched).await.unwrap_err().code(), Code::NotFound);
    let bad = client.submit(SubmitRequest::default()).await.unwrap_err();
    let fields: Vec<_> = violations(&bad).into_iter().map(|v| v.field).collect();
    assert_eq!(fields, ["client_id", "network_id", "sensor_id"]);
    service.end().await;
}

#[tokio::test]
async fn get_next_answers_before_its_caller_gives_up() {
    let directory = tempfile::tempdir().unwrap();
    let service = Service::start(directory.path()).await;
    let announce = crate::proto::AnnounceRequest {
        client_id: "a".to_owned(),
        network_id: "north".to_owned(),
        charger_id: "truck-1".to_owned(),
        t0: Some(prost_types::Timestamp { seconds: in_an_hour(), nanos: 0 }),
        ..crate::proto::AnnounceRequest::default()
    };
    let departures = &mut crate::proto::departure_service_client::DepartureServiceClient::new(
        service.channel.clone(),
    );
    departures.announce(announce).await.unwrap();
    let mut call = Request::new(GetNextRequest {
        network_id: "north".to_owned(),
        charger_id: "truck-1".to_owned(),
        departure_id: String::new(),
    });
    call.set_timeout(Duration::from_secs(1));
    let mut tours = TourServiceClient::new(service.channel.clone());
    let late = tours.get_next(call).await.unwrap_err();
    assert_eq!(late.code(), Code::DeadlineExceeded);
    // The service's words, not those of the client's own timer.
    assert!(late.message().contains("truck-1"), "{late}");
    service.end().await;
}

fn in_an_hour() -> i64 {
    use crate::clock::Clock;
    SystemClock.now().as_second() + 3_600
}
