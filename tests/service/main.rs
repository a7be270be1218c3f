//! The service from outside: the real binary on port 0 over a real database, through its two edges.
//!
//! `app` is the helper that every test starts with; the other modules are the sentences of the
//! contract (`proto/`, ARCHITECTURE.md), a module a subject. No test measures time: each waits for a
//! condition, for as long as a busy machine may need.

// Helpers fail by panicking, as tests do, and a test may ask what time it is.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)]
#![allow(clippy::disallowed_methods, missing_docs)]

mod app;
mod calls;
mod database;
mod field;
mod time;

/// Models that keep the contract, and such that break it.
#[path = "../common/onnx.rs"]
mod onnx;

mod access;
mod bad_input;
mod batch;
mod cancel;
mod config;
mod connections;
mod crash;
mod downtime;
mod durability;
mod explanations;
mod get_next;
mod idempotency;
mod life;
mod limits;
mod log_filter;
mod metrics;
mod monitoring;
mod operator;
mod pages;
mod policy;
mod process;
mod queue;
mod reopen;
mod rest;
mod scenario;
mod soak;
mod stream;
mod time_zero;
mod traces;
mod upgrade;
mod version;
mod watch;
