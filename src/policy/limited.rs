//! [`Limited`]: a Q-function that may take only so much time.

use std::sync::OnceLock;
use std::time::Duration;

use voltour_solver::policy::{Batch, QError, QFunction};

use crate::clock::Clock;

/// A Q-function within a share of the time of one solve. Counted is all that passes from its first use on, what its
/// caller does to ask it too; past the share there are no values any more.
pub struct Limited<'a> {
    function: &'a dyn QFunction,
    clock: &'a dyn Clock,
    share: Duration,
    /// How long the clock had run at the first use.
    since: OnceLock<Duration>,
}

impl<'a> Limited<'a> {
    /// So much for all calls together.
    pub fn new(function: &'a dyn QFunction, clock: &'a dyn Clock, share: Duration) -> Self {
        Self { function, clock, share, since: OnceLock::new() }
    }
}

impl QFunction for Limited<'_> {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        if !self.has_time() {
            return Err(QError::TooSlow);
        }
        let values = self.function.values(batch);
        if self.has_time() { values } else { Err(QError::TooSlow) }
    }

    fn reads_ahead(&self) -> bool {
        self.function.reads_ahead()
    }

    fn has_time(&self) -> bool {
        let ran = self.clock.ran();
        ran.saturating_sub(*self.since.get_or_init(|| ran)) <= self.share
    }
}
