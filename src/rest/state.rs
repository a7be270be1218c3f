//! What the handlers share.

use std::sync::Arc;

use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

use crate::metrics::Metrics;
use crate::store::Reads;

/// Pictures drawn at once; the others wait, within their requests' time-outs.
const PICTURES: usize = 2;

/// The reads, what is counted, and whether the service is going down.
#[derive(Clone, Debug)]
pub struct RestState {
    pub(super) reads: Reads,
    pub(super) metrics: Metrics,
    pub(super) shutting_down: CancellationToken,
    pub(super) pictures: Arc<Semaphore>,
}

impl RestState {
    /// `shutting_down` turns readiness off.
    pub fn new(reads: Reads, metrics: Metrics, shutting_down: CancellationToken) -> Self {
        Self { reads, metrics, shutting_down, pictures: Arc::new(Semaphore::new(PICTURES)) }
    }
}
