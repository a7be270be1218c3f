//! The beginning and the end of the log and of the spans.

use std::io::{self, IsTerminal};

use opentelemetry_sdk::trace::SdkTracerProvider;
use tracing_subscriber::Layer;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::{SubscriberInitExt, TryInitError};

use super::{LogFilter, spans};
use crate::config::{self, Format, Log};

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
    /// Spans cannot be sent there.
    #[error("telemetry.otlp_endpoint: {0}")]
    Otlp(#[from] opentelemetry_otlp::ExporterBuildError),
    /// Something else has begun before.
    #[error("log: {0}")]
    Init(#[from] TryInitError),
}

/// The log and the spans of this process.
#[derive(Debug)]
pub struct Telemetry {
    /// What of the log is written.
    pub filter: LogFilter,
    spans: Option<SdkTracerProvider>,
}

/// Begins to log, and to send spans where a collector is configured, which needs a runtime.
///
/// # Errors
/// The filter or the collector's address cannot be read, or logging has begun before.
pub fn init(log: &Log, telemetry: &config::Telemetry) -> Result<Telemetry, TelemetryError> {
    let bad = |source| TelemetryError::Filter { value: log.filter.clone(), source };
    let (filter, layer) = LogFilter::new(&log.filter).map_err(bad)?;
    let lines = tracing_subscriber::fmt::layer()
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal());
    let lines = match log.format {
        Format::Text => lines.boxed(),
        Format::Json => lines.json().boxed(),
    };
    let spans = spans::provider(telemetry)?;
    let exported = spans.as_ref().map(spans::layer);
    tracing_subscriber::registry().with(lines.with_filter(layer)).with(exported).try_init()?;
    Ok(Telemetry { filter, spans })
}

impl Telemetry {
    /// Sends what is still to be sent, for a moment; a collector that does not answer is not waited for.
    pub async fn end(self) {
        let Some(provider) = self.spans else { return };
        let ended =
            tokio::task::spawn_blocking(move || provider.shutdown_with_timeout(spans::LAST)).await;
        match ended {
            Ok(Ok(())) => {}
            Ok(Err(error)) => tracing::warn!(%error, "not all spans were sent"),
            Err(error) => tracing::warn!(%error, "not all spans were sent"),
        }
    }
}
