//! The service that messages and addresses are sent to: whole, in this process, with a clock that stands still, so
//! that nothing is planned meanwhile.

use std::sync::{Arc, OnceLock};
use std::time::Duration;

use jiff::Timestamp;
use tempfile::TempDir;
use tokio::runtime::Runtime;
use tonic::transport::{Channel, Endpoint};
use voltour::app::App;
use voltour::clock::ManualClock;
use voltour::config::{Config, Span};
use voltour::lifecycle::Lifecycle;
use voltour::proto::network_service_client::NetworkServiceClient;
use voltour::proto::{
    ChargerType, NetworkSpec, Objective, Place, Point, PutNetworkRequest, Sensor, Trajectory,
    Waypoint, place,
};
use voltour::telemetry::LogFilter;

/// What hangs so long is a defect; the time is long because the machine may be busy.
pub const PATIENCE: Duration = Duration::from_secs(20);

pub struct Service {
    runtime: Runtime,
    pub channel: Channel,
    pub rest: String,
    pub client: reqwest::Client,
    _directory: TempDir,
}

impl Service {
    /// The one service of this process, with the network `north` of the sensors `s0` to `s4` at rest and the moving `m`.
    pub fn running() -> &'static Self {
        static SERVICE: OnceLock<Service> = OnceLock::new();
        SERVICE.get_or_init(Self::start)
    }

    /// Waits for something that must not hang.
    pub fn wait<T>(&self, what: impl Future<Output = T>) -> T {
        self.runtime.block_on(async {
            tokio::time::timeout(PATIENCE, what).await.expect("an answer in time")
        })
    }

    fn start() -> Self {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .enable_all()
            .build()
            .expect("a runtime");
        let directory = tempfile::tempdir().expect("a directory");
        let mut config = Config::default();
        config.grpc.listen.set_port(0);
        config.rest.listen.set_port(0);
        config.store.path = directory.path().join("fuzz.db");
        config.limits.longest_wait = Span(Duration::from_millis(1));
        let now: Timestamp = "2026-01-01T00:00:00Z".parse().expect("a time");
        let clock = Arc::new(ManualClock::new(now));
        let (grpc, rest) = runtime.block_on(async {
            let app = App::start(&config, clock, Lifecycle::default(), LogFilter::default())
                .await
                .expect("a service");
            let addresses = (format!("http://{}", app.grpc), format!("http://{}", app.rest));
            tokio::spawn(app.run());
            addresses
        });
        let channel = runtime.block_on(async {
            let endpoint = Endpoint::from_shared(grpc).expect("an address");
            let channel = endpoint.connect().await.expect("a connection");
            let put = NetworkServiceClient::new(channel.clone()).put(north()).await;
            put.expect("the network");
            channel
        });
        let client = reqwest::Client::builder().timeout(PATIENCE).build().expect("a client");
        Self { runtime, channel, rest, client, _directory: directory }
    }
}

fn north() -> PutNetworkRequest {
    let at = |x_m: f64| Point { x_m, y_m: 0.0 };
    let sensor = |i: u32| Sensor {
        id: format!("s{i}"),
        place: Some(Place { place: Some(place::Place::PositionM(at(f64::from(i)))) }),
        battery_j: 100.0,
        ..Sensor::default()
    };
    let waypoint =
        Waypoint { time: Some(prost_types::Timestamp::default()), position_m: Some(at(9.0)) };
    let path = Trajectory { waypoints: vec![waypoint] };
    let moving = Sensor {
        id: "m".to_owned(),
        place: Some(Place { place: Some(place::Place::Trajectory(path)) }),
        battery_j: 100.0,
        ..Sensor::default()
    };
    let truck = ChargerType {
        name: "truck".to_owned(),
        speed_mps: 5.0,
        transfer_w: 1.0,
        start_m: Some(at(0.0)),
        ..ChargerType::default()
    };
    let spec = NetworkSpec {
        objective: Objective::MaxCount.into(),
        charger_types: vec![truck],
        sensors: (0..5).map(sensor).chain([moving]).collect(),
        ..NetworkSpec::default()
    };
    PutNetworkRequest {
        client_id: "put".to_owned(),
        network_id: "north".to_owned(),
        spec: Some(spec),
        expected_version: None,
    }
}
