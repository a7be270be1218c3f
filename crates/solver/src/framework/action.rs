//! [`Action`]: a candidate, and where the insertion function would put it.

use crate::tour::Insertion;

/// A legal action in a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action {
    /// The candidate.
    pub candidate: u32,
    /// Where the insertion function puts it, and what that costs.
    pub insertion: Insertion,
    /// Share of the positions looked at that are legal.
    pub legal_share: f64,
    /// By how much the second-cheapest legal position costs more; infinite if there is none.
    pub regret: f64,
    /// The reward r(s, v), in the units of the problem's objective function.
    pub reward: f64,
}
