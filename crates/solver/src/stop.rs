//! When a search ends. The solver reads no clock: whoever runs it passes a rule, and a search asks
//! it once an iteration. The same rule on iterations gives the same tour.

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

/// Any function of the iterations done; this is how a host brings its clock and its cancellation.
impl<F: Fn(u64) -> bool> StopRule for F {
    fn should_stop(&self, iterations: u64) -> bool {
        self(iterations)
    }
}
