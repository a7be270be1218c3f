//! Spans to an OpenTelemetry collector (OTLP over gRPC). They are gathered and sent by a thread of their own; where
//! the collector is away or slow, they are dropped, and nothing waits for it.

use std::time::Duration;

use opentelemetry::trace::TracerProvider;
use opentelemetry_otlp::{ExporterBuildError, SpanExporter, WithExportConfig};
use opentelemetry_sdk::Resource;
use opentelemetry_sdk::trace::{
    BatchConfigBuilder, BatchSpanProcessor, Sampler, SdkTracerProvider,
};
use tracing::Subscriber;
use tracing::level_filters::LevelFilter;
use tracing_subscriber::Layer;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::registry::LookupSpan;

use crate::config;

/// At the end so long is waited for the collector.
pub(super) const LAST: Duration = Duration::from_secs(2);
/// A collector has so long to take what is sent.
const PATIENCE: Duration = Duration::from_secs(5);
/// Spans are sent so often.
const OFTEN: Duration = Duration::from_secs(1);
/// Spans that may wait to be sent; further ones are dropped.
const QUEUE: usize = 8_192;

/// Where spans go; none where no collector is configured.
pub(super) fn provider(
    telemetry: &config::Telemetry,
) -> Result<Option<SdkTracerProvider>, ExporterBuildError> {
    let Some(endpoint) = &telemetry.otlp_endpoint else { return Ok(None) };
    let exporter = SpanExporter::builder()
        .with_tonic()
        .with_endpoint(endpoint)
        .with_timeout(PATIENCE)
        .build()?;
    let batches =
        BatchConfigBuilder::default().with_scheduled_delay(OFTEN).with_max_queue_size(QUEUE);
    let processor =
        BatchSpanProcessor::builder(exporter).with_batch_config(batches.build()).build();
    let sampler = Sampler::TraceIdRatioBased(telemetry.sample_ratio);
    let provider = SdkTracerProvider::builder()
        .with_span_processor(processor)
        .with_sampler(Sampler::ParentBased(Box::new(sampler)))
        .with_resource(Resource::builder().with_service_name("voltour").build());
    Ok(Some(provider.build()))
}

/// The layer that makes spans of ours; not of libraries, least of all of those that send them.
pub(super) fn layer<S>(provider: &SdkTracerProvider) -> impl Layer<S> + use<S>
where
    S: Subscriber + for<'a> LookupSpan<'a>,
{
    let ours = Targets::new().with_target("voltour", LevelFilter::DEBUG);
    tracing_opentelemetry::layer().with_tracer(provider.tracer("voltour")).with_filter(ours)
}
