//! The only look at the wall clock: how long a training took, and when an evaluation must look at its thread's.

use std::time::Instant;

/// Runs from its making on.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Runs from now on.
    #[allow(
        clippy::disallowed_methods,
        reason = "a training or an evaluation is where the clock comes in"
    )]
    pub fn start() -> Self {
        Self(Instant::now())
    }

    /// Seconds since its start.
    pub fn seconds(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}
