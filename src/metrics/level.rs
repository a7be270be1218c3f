//! How many of something there are now: entered and, by whatever way, left.

use prometheus_client::metrics::gauge::Gauge;

/// Counts what is inside; clones count together.
#[derive(Clone, Debug, Default)]
pub struct Level(pub(super) Gauge);

impl Level {
    /// One more, until what is returned is dropped.
    pub fn enter(&self) -> Entered {
        self.0.inc();
        Entered(self.0.clone())
    }

    /// How many there are.
    pub fn count(&self) -> i64 {
        self.0.get()
    }
}

/// One that is inside for as long as this lives.
#[derive(Debug)]
pub struct Entered(Gauge);

impl Drop for Entered {
    fn drop(&mut self) {
        self.0.dec();
    }
}
