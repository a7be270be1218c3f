//! The voltour service: takes charging requests, plans tours, keeps both.

pub mod access;
pub mod app;
pub mod bench;
pub mod cli;
pub mod clock;
pub mod config;
pub mod demo;
pub mod domain;
pub mod explainer;
pub mod geojson;
pub mod grpc;
pub mod lifecycle;
pub mod listen;
pub mod metrics;
pub mod planner;
pub mod policy;
pub mod rest;
pub mod retention;
pub mod scheduler;
pub mod store;
pub mod svg;
pub mod telemetry;
pub mod tls;

/// The generated gRPC contract. Only the gRPC edge and the clients see it.
#[allow(missing_docs, clippy::all, clippy::pedantic)]
pub mod proto {
    tonic::include_proto!("voltour.v1");

    /// The encoded descriptors, for reflection.
    pub const DESCRIPTORS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/descriptors.bin"));
}
