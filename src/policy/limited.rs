//! [`Limited`]: a Q-function that may take only so much time.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use voltour_solver::policy::{Batch, QError, QFunction};

use crate::clock::Clock;

/// A Q-function within a share of the time of one solve. Counted is what its calls take, by the caller's
/// clock; past the share there are no values any more.
pub struct Limited<'a> {
    function: &'a dyn QFunction,
    clock: &'a dyn Clock,
    share: Duration,
    /// Microseconds.
    spent: AtomicU64,
}

impl<'a> Limited<'a> {
    /// So much for all calls together.
    pub fn new(function: &'a dyn QFunction, clock: &'a dyn Clock, share: Duration) -> Self {
        Self { function, clock, share, spent: AtomicU64::new(0) }
    }

    fn is_over(&self) -> bool {
        Duration::from_micros(self.spent.load(Ordering::Relaxed)) > self.share
    }
}

impl QFunction for Limited<'_> {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        if self.is_over() {
            return Err(QError::TooSlow);
        }
        let from = self.clock.now();
        let values = self.function.values(batch);
        // A clock that was set back has measured nothing.
        let took = self.clock.now().as_microsecond().saturating_sub(from.as_microsecond());
        self.spent.fetch_add(took.max(0).unsigned_abs(), Ordering::Relaxed);
        if self.is_over() { Err(QError::TooSlow) } else { values }
    }
}
