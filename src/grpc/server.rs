//! The server: the four services, health and reflection on one listener.

use std::time::Duration;

use tokio::sync::watch;
use tokio_util::sync::CancellationToken;
use tonic::server::NamedService;
use tonic_health::ServingStatus;
use tonic_health::server::HealthReporter;
use tower_http::auth::AsyncRequireAuthorizationLayer;
use tracing::field::Empty;

use super::Edge;
use super::count::{Count, Room};
use super::guard::Guard;
use crate::listen::{self, Counted};
use crate::proto::DESCRIPTORS;
use crate::proto::departure_service_server::DepartureServiceServer;
use crate::proto::network_service_server::NetworkServiceServer;
use crate::proto::request_service_server::RequestServiceServer;
use crate::proto::tour_service_server::TourServiceServer;
use crate::store::Trouble;
use crate::telemetry::of_caller;

/// Bytes of a call's headers.
const HEADER_BYTES: u32 = 16 * 1024;
/// A connection that is silent for so long is asked whether it is still there.
const KEEPALIVE: Duration = Duration::from_secs(30);
/// And it has so long to answer.
const KEEPALIVE_ANSWER: Duration = Duration::from_secs(10);
/// What a call may take beyond the longest wait before it is cut off.
const CALL_SLACK: Duration = Duration::from_secs(10);

/// What went wrong with the server itself.
#[derive(Debug, thiserror::Error)]
pub enum ServerError {
    /// The descriptors that reflection shows are broken.
    #[error("reflection: {0}")]
    Reflection(#[from] tonic_reflection::server::Error),
    /// The transport gave up.
    #[error("transport: {0}")]
    Transport(#[from] tonic::transport::Error),
}

/// Serves until the edge is stopped and the calls that run then are answered.
#[derive(Debug)]
pub struct Server {
    edge: Edge,
    listener: Counted,
}

impl Server {
    /// On a bound listener.
    pub fn new(edge: Edge, listener: Counted) -> Self {
        Self { edge, listener }
    }

    /// Runs to its end.
    pub async fn run(self) -> Result<(), ServerError> {
        let Self { edge, listener } = self;
        let (limits, stop, calls) = (edge.limits, edge.stop.clone(), edge.calls.clone());
        let room = Room::new(limits.all_calls);
        let (reporter, health) = tonic_health::server::health_reporter();
        let mut trouble = edge.handle.reads().trouble();
        // Before anybody can ask: whoever watches hears of every report, also of one that says the same again.
        let present = status(*trouble.borrow_and_update());
        report(&reporter, present).await;
        let able = tokio::spawn(able(reporter.clone(), present, trouble, stop.clone()));
        let reflection = || {
            tonic_reflection::server::Builder::configure()
                .register_encoded_file_descriptor_set(DESCRIPTORS)
                .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
        };
        macro_rules! limited {
            ($server:ident) => {
                $server::new(edge.clone())
                    .max_decoding_message_size(limits.message_bytes)
                    .max_encoding_message_size(limits.message_bytes)
            };
        }
        let stopping = async move {
            stop.cancelled().await;
            // It has the last word no more.
            let _ = able.await;
            report(&reporter, ServingStatus::NotServing).await;
            // Ends the watches of the health service, which would keep their connections open.
            close(reporter).await;
        };
        tonic::transport::Server::builder()
            .trace_fn(|call| {
                let path = call.uri().path();
                let span = tracing::debug_span!("grpc", otel.name = path, path, departure = Empty);
                of_caller(span, call.headers())
            })
            .timeout(limits.longest_wait + CALL_SLACK)
            .max_concurrent_streams(limits.calls)
            .http2_max_header_list_size(HEADER_BYTES)
            .http2_keepalive_interval(Some(KEEPALIVE))
            .http2_keepalive_timeout(Some(KEEPALIVE_ANSWER))
            .layer(tower::layer::layer_fn(move |inner| {
                Count::new(inner, calls.clone(), limits, room.clone())
            }))
            .layer(AsyncRequireAuthorizationLayer::new(Guard(edge.gate.clone())))
            .add_service(health)
            .add_service(reflection().build_v1()?)
            // What many clients still ask, Python's among them.
            .add_service(reflection().build_v1alpha()?)
            .add_service(limited!(NetworkServiceServer))
            .add_service(limited!(RequestServiceServer))
            .add_service(limited!(DepartureServiceServer))
            .add_service(limited!(TourServiceServer))
            .serve_with_incoming_shutdown(listen::incoming(listener), stopping)
            .await?;
        Ok(())
    }
}

/// Every service of ours, and the empty name that stands for all.
const SERVICES: [&str; 5] = [
    "",
    NetworkServiceServer::<Edge>::NAME,
    RequestServiceServer::<Edge>::NAME,
    DepartureServiceServer::<Edge>::NAME,
    TourServiceServer::<Edge>::NAME,
];

/// The services serve for as long as something can be written.
fn status(trouble: Option<Trouble>) -> ServingStatus {
    if trouble.is_none() { ServingStatus::Serving } else { ServingStatus::NotServing }
}

/// Says so whenever it becomes different from what was `said`.
async fn able(
    reporter: HealthReporter,
    mut said: ServingStatus,
    mut trouble: watch::Receiver<Option<Trouble>>,
    stop: CancellationToken,
) {
    while let Some(Ok(())) = stop.run_until_cancelled(trouble.changed()).await {
        let present = status(*trouble.borrow_and_update());
        if present != said {
            report(&reporter, present).await;
            said = present;
        }
    }
}

async fn report(reporter: &HealthReporter, status: ServingStatus) {
    for service in SERVICES {
        reporter.set_service_status(service, status).await;
    }
}

async fn close(mut reporter: HealthReporter) {
    for service in SERVICES {
        reporter.clear_service_status(service).await;
    }
}
