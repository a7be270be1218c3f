//! The share of the time.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use voltour_solver::policy::{Batch, QError, QFunction};

use super::support::batch;
use crate::clock::ManualClock;
use crate::policy::Limited;

/// A function that takes a second for each state, by the clock.
struct Slow(Arc<ManualClock>);

impl QFunction for Slow {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        self.0.advance(Duration::from_secs(batch.states as u64));
        Ok(vec![0.0; batch.mask.len()])
    }
}

#[test]
fn a_share_of_the_time_is_for_all_calls_together() {
    let clock = Arc::new(ManualClock::new(Timestamp::UNIX_EPOCH));
    let slow = Slow(clock.clone());
    let limited = Limited::new(&slow, &*clock, Duration::from_secs(3));
    // What passes before it is used does not count.
    clock.advance(Duration::from_secs(60));
    assert!(limited.values(&batch(1, 1)).is_ok());
    // What its caller does meanwhile does, and no change of the time of day.
    clock.advance(Duration::from_secs(1));
    clock.set(Timestamp::UNIX_EPOCH);
    assert!(limited.values(&batch(1, 1)).is_ok() && limited.has_time());
    assert_eq!(limited.values(&batch(1, 1)), Err(QError::TooSlow));
    assert!(!limited.has_time());
    assert_eq!(limited.values(&batch(1, 1)), Err(QError::TooSlow), "and it is not asked again");
}
