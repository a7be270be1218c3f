//! The REST edge: what the service has stored, to be read. Nothing of it is changed here; every error is a
//! problem document (RFC 9457), logged once if it is the service's own.

mod accept;
mod count;
mod described;
mod docs;
mod dress;
mod explanations;
mod export;
mod guard;
mod health;
mod immutable;
mod lists;
mod log_filter;
mod metrics;
mod openapi;
mod plan_forms;
mod plans;
mod problem;
mod query;
mod router;
mod routes;
mod server;
mod state;
mod view;

#[cfg(test)]
mod tests;

pub use guard::Guard;
pub use router::router;
pub use server::serve;
pub use state::RestState;
