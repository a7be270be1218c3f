//! The operator's commands: they do over gRPC, against a running service, what its clients do.

mod arguments;
mod charger;
mod client;
mod command;
mod depart;
mod health;
mod ndjson;
mod network;
mod remote;
mod request;
mod show;
mod tour;

pub(crate) use arguments::fresh_id;
pub(crate) use client::{call, refused, unreadable, waiting};
pub use command::{Command, run};
pub(crate) use remote::{Remote, Service};
