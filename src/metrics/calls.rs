//! The calls of both edges: how many, how they ended, and how long they took. Methods and routes are named as the
//! access table names them, whatever the caller has written.

use std::sync::Arc;
use std::time::Duration;

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use tonic::Code;

use super::labels::{
    EdgeLabels, GrpcLabels, MethodLabels, RestLabels, RouteLabels, SubmissionLabels,
};
use super::{Level, TIMES_S};
use crate::access::table;
use crate::clock::Clock;
use crate::domain::Refusal;

/// What has no entry in the access table.
const UNKNOWN: &str = "unknown";

/// Clones count together.
#[derive(Clone, Debug)]
pub struct Calls {
    clock: Arc<dyn Clock>,
    grpc: Family<GrpcLabels, Counter>,
    grpc_time: Family<MethodLabels, Histogram, fn() -> Histogram>,
    rest: Family<RestLabels, Counter>,
    rest_time: Family<RouteLabels, Histogram, fn() -> Histogram>,
    submissions: Family<SubmissionLabels, Counter>,
    connections: Family<EdgeLabels, prometheus_client::metrics::gauge::Gauge>,
    /// Watches and submission streams that are open.
    pub streams: Level,
    /// Calls that wait for a tour.
    pub waits: Level,
}

impl Calls {
    pub(super) fn register(
        registry: &mut Registry,
        clock: Arc<dyn Clock>,
        submissions: Family<SubmissionLabels, Counter>,
    ) -> Self {
        let counted = Self {
            clock,
            grpc: Family::default(),
            grpc_time: Family::new_with_constructor(|| Histogram::new(TIMES_S)),
            rest: Family::default(),
            rest_time: Family::new_with_constructor(|| Histogram::new(TIMES_S)),
            submissions,
            connections: Family::default(),
            streams: Level::default(),
            waits: Level::default(),
        };
        registry.register("grpc_calls", "gRPC calls that ended, by code", counted.grpc.clone());
        let help = "Time of gRPC calls that do not wait and are no streams";
        registry.register_with_unit(
            "grpc_call_time",
            help,
            Unit::Seconds,
            counted.grpc_time.clone(),
        );
        registry.register("rest_calls", "REST calls that were answered", counted.rest.clone());
        let help = "Time until the answer of a REST call began";
        registry.register_with_unit(
            "rest_call_time",
            help,
            Unit::Seconds,
            counted.rest_time.clone(),
        );
        registry.register("connections", "Connections that are open", counted.connections.clone());
        let help = "Watches and submission streams that are open";
        registry.register("streams", help, counted.streams.0.clone());
        let help = "Calls that wait for the tour of a charger";
        registry.register("tour_waits", help, counted.waits.0.clone());
        for edge in ["grpc", "rest"] {
            counted.connections(edge);
        }
        counted
    }

    /// The open connections of an edge.
    pub fn connections(&self, edge: &'static str) -> Level {
        Level(self.connections.get_or_create_owned(&EdgeLabels { edge }))
    }

    /// A gRPC call begins.
    pub fn grpc(&self, path: &str) -> GrpcCall {
        let entry = table::GRPC.iter().find(|(entry, _)| *entry == path);
        let method = entry.map_or(UNKNOWN, |(path, _)| path.trim_start_matches('/'));
        GrpcCall { calls: self.clone(), method, began: self.clock.ran(), code: Code::Cancelled }
    }

    /// A REST call begins; what is returned takes the status of its answer.
    pub fn rest(&self, method: &str, route: Option<&str>) -> impl FnOnce(u16) + use<> {
        let entry = table::REST.iter().find(|(entry, _)| Some(*entry) == route);
        let route = entry.map_or(UNKNOWN, |(route, _)| *route);
        let method = ["GET", "HEAD", "PUT"].into_iter().find(|known| *known == method);
        let (calls, began) = (self.clone(), self.clock.ran());
        move |status| {
            let labels = RestLabels { method: method.unwrap_or("other"), route, code: status };
            calls.rest.get_or_create_owned(&labels).inc();
            let took_s = calls.since(began);
            calls.rest_time.get_or_create_owned(&RouteLabels { route }).observe(took_s);
        }
    }

    /// A charging request was not stored.
    pub fn refused(&self, refusal: &Refusal) {
        let outcome = match refusal {
            Refusal::Invalid(_) => "invalid",
            Refusal::NotFound { .. } => "not_found",
            Refusal::AlreadyExists { .. } => "already_exists",
            Refusal::ResourceExhausted { .. } => "exhausted",
            Refusal::Unavailable(_) => "unavailable",
            _ => "refused",
        };
        self.submissions.get_or_create_owned(&SubmissionLabels { outcome }).inc();
    }

    fn since(&self, began: Duration) -> f64 {
        self.clock.ran().saturating_sub(began).as_secs_f64()
    }
}

/// A gRPC call that runs; it is counted when this is dropped, as cancelled where nobody said how it ended.
#[derive(Debug)]
pub struct GrpcCall {
    calls: Calls,
    method: &'static str,
    began: Duration,
    code: Code,
}

impl GrpcCall {
    /// How it ended.
    pub fn ended(&mut self, code: Code) {
        self.code = code;
    }
}

impl Drop for GrpcCall {
    fn drop(&mut self) {
        let Self { calls, method, .. } = self;
        let labels = GrpcLabels { method, code: name(self.code) };
        calls.grpc.get_or_create_owned(&labels).inc();
        if !waits(method) {
            let took_s = calls.since(self.began);
            calls.grpc_time.get_or_create_owned(&MethodLabels { method }).observe(took_s);
        }
    }
}

/// Whether a method is as long as its caller likes.
fn waits(method: &str) -> bool {
    ["/Watch", "/SubmitStream", "/GetNext", "/ServerReflectionInfo"]
        .iter()
        .any(|end| method.ends_with(end))
}

/// As the gRPC status codes are spelled.
fn name(code: Code) -> &'static str {
    match code {
        Code::Ok => "OK",
        Code::Cancelled => "CANCELLED",
        Code::Unknown => "UNKNOWN",
        Code::InvalidArgument => "INVALID_ARGUMENT",
        Code::DeadlineExceeded => "DEADLINE_EXCEEDED",
        Code::NotFound => "NOT_FOUND",
        Code::AlreadyExists => "ALREADY_EXISTS",
        Code::PermissionDenied => "PERMISSION_DENIED",
        Code::ResourceExhausted => "RESOURCE_EXHAUSTED",
        Code::FailedPrecondition => "FAILED_PRECONDITION",
        Code::Aborted => "ABORTED",
        Code::OutOfRange => "OUT_OF_RANGE",
        Code::Unimplemented => "UNIMPLEMENTED",
        Code::Internal => "INTERNAL",
        Code::Unavailable => "UNAVAILABLE",
        Code::DataLoss => "DATA_LOSS",
        Code::Unauthenticated => "UNAUTHENTICATED",
    }
}
