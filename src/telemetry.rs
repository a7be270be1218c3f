//! Logs: to standard error, as text or JSON. Standard output is the commands'.

use std::io::{self, IsTerminal};

use tracing_subscriber::EnvFilter;
use tracing_subscriber::util::{SubscriberInitExt, TryInitError};

use crate::config::{Format, Log};

/// Why logging could not begin.
#[derive(Debug, thiserror::Error)]
pub enum TelemetryError {
    /// The filter is none.
    #[error("log.filter: {value:?}: {source}")]
    Filter {
        /// As it was configured.
        value: String,
        /// What is wrong with it.
        source: tracing_subscriber::filter::ParseError,
    },
    /// Something else has begun before.
    #[error("log: {0}")]
    Init(#[from] TryInitError),
}

/// Begins to log.
///
/// # Errors
/// The filter cannot be read, or logging has begun before.
pub fn init(log: &Log) -> Result<(), TelemetryError> {
    let builder = tracing_subscriber::fmt()
        .with_env_filter(filter(log)?)
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal());
    match log.format {
        Format::Text => builder.finish().try_init()?,
        Format::Json => builder.json().finish().try_init()?,
    }
    Ok(())
}

/// The filter, which has a grammar of its own.
///
/// # Errors
/// It cannot be read.
pub fn filter(log: &Log) -> Result<EnvFilter, TelemetryError> {
    EnvFilter::try_new(&log.filter)
        .map_err(|source| TelemetryError::Filter { value: log.filter.clone(), source })
}
