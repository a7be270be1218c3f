//! [`Definition`]: in what a problem differs from another.

use super::{Action, State};

/// The insertion function g of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insert {
    /// At the legal place that costs least of what the problem is short of.
    Cheapest,
    /// At the end.
    Append,
}

/// A problem of the framework (paper, section 5.3).
///
/// Every limit of the scenario (deadlines, ready times, time span, capacity) is heeded in every problem: an
/// action that breaks one is none. So is every demand: as long as one is open, only candidates that help
/// to meet one are actions.
pub trait Definition: Send + Sync {
    /// Its name.
    fn name(&self) -> &'static str;

    /// The insertion function g.
    fn insertion(&self) -> Insert;

    /// The objective function f of a partial solution: larger is better, in units that do not change with
    /// the scale of the scenario ([`super::Scales`]).
    fn objective(&self, state: &State<'_>) -> f64;

    /// The reward r(s, v) = f(g(s, v)) - f(s) of an action whose place is known.
    fn reward(&self, state: &State<'_>, candidate: u32, place: &Action) -> f64;

    /// The stop function, beyond what always ends an episode: that no legal action is left.
    fn stops(&self, state: &State<'_>) -> bool;
}
