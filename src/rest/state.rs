//! What the handlers share.

use std::sync::Arc;

use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

use crate::metrics::Metrics;
use crate::store::Reads;
use crate::telemetry::LogFilter;

/// Pictures drawn at once; the others wait, within their requests' time-outs.
const PICTURES: usize = 2;

/// The reads, what is counted and logged, and whether the service is going down.
#[derive(Clone, Debug)]
pub struct RestState {
    pub(super) reads: Reads,
    pub(super) metrics: Metrics,
    pub(super) log: LogFilter,
    pub(super) shutting_down: CancellationToken,
    pub(super) pictures: Arc<Semaphore>,
}

impl RestState {
    /// `shutting_down` turns readiness off.
    pub fn new(
        reads: Reads,
        metrics: Metrics,
        log: LogFilter,
        shutting_down: CancellationToken,
    ) -> Self {
        let pictures = Arc::new(Semaphore::new(PICTURES));
        Self { reads, metrics, log, shutting_down, pictures }
    }
}
