//! What the service says of itself beside its metrics: a log, to standard error as text or JSON, and, where a collector
//! is configured, spans. Standard output is the commands'.

mod caller;
mod filter;
mod log;
mod spans;

pub use caller::of_caller;
pub use filter::{LogFilter, filter};
pub use log::{Telemetry, TelemetryError, init};
