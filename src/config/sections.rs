//! The sections, one struct a concern, each with its defaults.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Span;
use crate::access::Secret;

/// All of it.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// `[grpc]`
    pub grpc: Grpc,
    /// `[rest]`
    pub rest: Rest,
    /// `[tls]`
    pub tls: Tls,
    /// `[access]`
    pub access: Access,
    /// `[store]`
    pub store: Store,
    /// `[retention]`
    pub retention: Retention,
    /// `[planning]`
    pub planning: Planning,
    /// `[policy]`
    pub policy: Policy,
    /// `[limits]`
    pub limits: Limits,
    /// `[lifecycle]`
    pub lifecycle: Lifecycle,
    /// `[log]`
    pub log: Log,
    /// `[telemetry]`
    pub telemetry: Telemetry,
}

/// Where gRPC is served.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Grpc {
    /// Loopback only as long as there is no token; port 0 takes a free one.
    pub listen: SocketAddr,
}

/// Where REST is served.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rest {
    /// Loopback only as long as there is no token; port 0 takes a free one.
    pub listen: SocketAddr,
    /// Names beside `localhost` that are answered to on a loopback address.
    pub hosts: Vec<String>,
}

/// The certificates of both ports; no TLS where there is none.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tls {
    /// PEM: the service's certificate, and those between it and its root.
    pub certificate_file: Option<PathBuf>,
    /// PEM: its private key.
    pub key_file: Option<PathBuf>,
    /// PEM: only clients with a certificate of one of these are let in.
    pub client_ca_file: Option<PathBuf>,
}

/// Tokens that are not in the database.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Access {
    /// An admin's token for all networks; meant for the environment.
    pub bootstrap_token: Option<Secret>,
    /// A file with such a token and nothing else.
    pub bootstrap_token_file: Option<PathBuf>,
}

/// The database.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Store {
    /// Its file; made where there is none.
    pub path: PathBuf,
}

/// What is deleted, and when.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Retention {
    /// Requests and departures, with their plans, tours and visits, go so long after they ended; never if none.
    pub history: Option<Span>,
}

/// How tours are planned.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Planning {
    /// Which solver plans.
    pub solver: String,
    /// Time that the search for a tour may take.
    pub budget: Span,
    /// Time that the explanation of a plan may take, after its tour is out; 0 for none.
    pub explanation_budget: Span,
    /// From the close of a batch to the departure; the budget and a second if none.
    pub lead: Option<Span>,
    /// A departure that would start later than this is missed.
    pub max_late: Span,
    /// A tour of which nothing was heard for so long after its planned finish is overdue.
    pub overdue_after: Span,
    /// Seed of every search.
    pub seed: u64,
    /// Departures of different networks that are planned at once.
    pub threads: usize,
}

/// The trained policies.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Policy {
    /// Folder with models that stand in place of those in the binary: `k_coverage.onnx`, `reward.onnx`,
    /// `mobile.onnx`.
    pub folder: Option<PathBuf>,
}

/// What bounds the edges.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// Bytes of one message.
    pub message_bytes: usize,
    /// Connections at once, gRPC and REST each.
    pub connections: usize,
    /// gRPC calls at once on one connection.
    pub calls: u32,
    /// Watches and submission streams at once, over all connections.
    pub streams: usize,
    /// gRPC calls at once over all connections, but for health checks.
    pub all_calls: usize,
    /// Calls at once that wait for a tour.
    pub waits: usize,
    /// REST calls at once, but for health checks and metrics.
    pub rest_calls: usize,
    /// Items of one submission stream that are taken and not acknowledged yet.
    pub unacknowledged: usize,
    /// How long a call waits at most.
    pub longest_wait: Span,
    /// A client may be so slow with a call's head, or with taking what is sent to it.
    pub slow_client: Span,
    /// Networks.
    pub networks: u32,
    /// Departures of a network that wait for their plan.
    pub departures: u32,
}

/// How the service ends.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lifecycle {
    /// Time for running calls and searches after the first signal.
    pub stop_within: Span,
}

/// What is logged, to standard error.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Log {
    /// How lines look.
    pub format: Format,
    /// As `tracing` spells filters, such as `info,voltour=debug`.
    pub filter: String,
}

/// Spans for a collector.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Telemetry {
    /// Where an OpenTelemetry collector takes OTLP over gRPC: `http://HOST:PORT`; no spans if none.
    pub otlp_endpoint: Option<String>,
    /// Share of the traces that is sent, from 0 to 1.
    pub sample_ratio: f64,
}

/// How log lines look.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Format {
    /// For people.
    Text,
    /// One JSON object a line.
    Json,
}

const fn loopback(port: u16) -> SocketAddr {
    SocketAddr::new(std::net::IpAddr::V4(Ipv4Addr::LOCALHOST), port)
}

impl Default for Grpc {
    fn default() -> Self {
        Self { listen: loopback(7440) }
    }
}

impl Default for Rest {
    fn default() -> Self {
        Self { listen: loopback(7480), hosts: Vec::new() }
    }
}

impl Default for Store {
    fn default() -> Self {
        Self { path: "voltour.db".into() }
    }
}

impl Default for Planning {
    fn default() -> Self {
        Self {
            solver: "auto".to_owned(),
            budget: Span::seconds(2),
            explanation_budget: Span::seconds(2),
            lead: None,
            max_late: Span::seconds(600),
            overdue_after: Span::seconds(1_800),
            seed: 0,
            threads: 1,
        }
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            message_bytes: 4 * 1024 * 1024,
            connections: 1_000,
            calls: 1_000,
            streams: 256,
            all_calls: 10_000,
            waits: 1_000,
            rest_calls: 64,
            unacknowledged: 1_000,
            longest_wait: Span::seconds(300),
            slow_client: Span::seconds(30),
            networks: 1_000,
            departures: 1_000,
        }
    }
}

impl Default for Lifecycle {
    fn default() -> Self {
        Self { stop_within: Span::seconds(10) }
    }
}

impl Default for Telemetry {
    fn default() -> Self {
        Self { otlp_endpoint: None, sample_ratio: 1.0 }
    }
}

impl Default for Log {
    fn default() -> Self {
        Self { format: Format::Text, filter: "info".to_owned() }
    }
}
