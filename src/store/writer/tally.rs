//! What a transaction did, told to the metrics once it is committed.

use crate::domain::DepartureState;
use crate::metrics::WriterMetrics;
use crate::store::words::Word;

/// Of one transaction.
#[derive(Debug, Default)]
pub(in crate::store) struct Tally {
    /// Requests stored.
    pub accepted: u64,
    /// Requests that had been stored before, and were answered again.
    pub duplicates: u64,
    /// Departures that came to their end, and how.
    pub ended: Vec<DepartureState>,
}

impl Tally {
    /// Counts it.
    pub fn tell(&self, metrics: &WriterMetrics) {
        metrics.submitted(self.accepted, self.duplicates);
        self.ended.iter().for_each(|state| metrics.ended(state.word()));
    }
}
