//! When a search ends. The solver reads no clock: whoever runs it passes a rule, and a search asks
//! it once an iteration. The same rule on iterations gives the same tour.

use std::cell::Cell;

/// Tells a search when to end.
pub trait StopRule {
    /// Whether to end now, after `iterations` whole iterations.
    fn should_stop(&self, iterations: u64) -> bool;

    /// Hears that a solver is done with its part, so that a host with a clock can tell how long each took.
    fn done(&self, _solver: &str) {}
}

/// Ends after a number of iterations: the repeatable rule.
#[derive(Clone, Copy, Debug)]
pub struct MaxIterations(pub u64);

impl StopRule for MaxIterations {
    fn should_stop(&self, iterations: u64) -> bool {
        iterations >= self.0
    }
}

/// Ends when a clock that takes long to read, such as the processor time of a thread, is at a limit. It is read only
/// when another one, which never runs slower, says that the limit may be reached. Both tell seconds.
pub struct Limit<D, C> {
    dear_s: D,
    cheap_s: C,
    limit_s: f64,
    /// When to read the dear clock, by the cheap one.
    read_at_s: Cell<f64>,
}

impl<D: Fn() -> f64, C: Fn() -> f64> Limit<D, C> {
    /// Reads neither clock yet.
    pub fn new(limit_s: f64, dear_s: D, cheap_s: C) -> Self {
        Self { dear_s, cheap_s, limit_s, read_at_s: Cell::new(f64::NEG_INFINITY) }
    }

    /// Whether the limit is reached.
    pub fn is_over(&self) -> bool {
        let now_s = (self.cheap_s)();
        if now_s < self.read_at_s.get() {
            return false;
        }
        let left_s = self.limit_s - (self.dear_s)();
        self.read_at_s.set(now_s + left_s);
        left_s <= 0.0
    }
}

impl<D: Fn() -> f64, C: Fn() -> f64> StopRule for Limit<D, C> {
    fn should_stop(&self, _: u64) -> bool {
        self.is_over()
    }
}

/// Any function of the iterations done; this is how a host brings its clock and its cancellation.
impl<F: Fn(u64) -> bool> StopRule for F {
    fn should_stop(&self, iterations: u64) -> bool {
        self(iterations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dear_clock_is_read_seldom_and_in_time() {
        let (wall_s, processor_s) = (Cell::new(100.0), Cell::new(0.0));
        let reads = Cell::new(0);
        let dear_s = || {
            reads.set(reads.get() + 1);
            processor_s.get()
        };
        let limit = Limit::new(1.0, dear_s, || wall_s.get());
        // The thread runs every other moment.
        for moment in 0..1_024_u32 {
            assert!(!limit.is_over(), "{moment}");
            wall_s.set(wall_s.get() + 1.0 / 512.0);
            processor_s.set(processor_s.get() + f64::from(moment % 2) / 512.0);
        }
        assert!(reads.get() < 20, "{}", reads.get());
        assert!(limit.is_over() && limit.is_over());
        let first = Limit::new(0.0, || 0.0, || 0.0);
        assert!(first.is_over() && first.should_stop(7));
    }
}
