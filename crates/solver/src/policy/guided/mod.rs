//! Construction that a Q-function guides: greedy and sampled roll-outs, beam, look-ahead, re-insertion.
//!
//! No local search: what is here is how the solver `dqn` builds tours, and how its control does, which is
//! the same search with a [`Rule`] in place of a trained function.

mod beam;
mod construct;
mod guide;
mod kept;
mod look_ahead;
mod reinsert;
mod roll_out;
mod rule;

pub use construct::Effort;
pub use guide::Guide;
pub use kept::Kept;
pub use reinsert::reinsert;
pub use rule::Rule;

#[cfg(test)]
mod tests;
