//! The voltour service: takes charging requests, plans tours, keeps both.

pub mod clock;
pub mod domain;
pub mod planner;
pub mod scheduler;
pub mod store;

/// The generated gRPC contract. Only the gRPC edge and the clients see it.
#[allow(missing_docs, clippy::all, clippy::pedantic)]
pub mod proto {
    tonic::include_proto!("voltour.v1");

    /// The encoded descriptors, for reflection.
    pub const DESCRIPTORS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/descriptors.bin"));
}
