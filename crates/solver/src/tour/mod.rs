//! A tour: a sequence of candidates, its schedule, and the records that make a change cheap to judge.
//!
//! [`Run`] is the charger after a prefix, [`Segment`] a run of stops as a constant-size record, and
//! [`Tour`] holds both for every position. Where segments do not concatenate (`design.md`), the tour
//! simulates forward instead; whoever asks does not see the difference.

mod insertion;
mod run;
mod segment;
mod sequence;
mod value;
mod visit;

pub use insertion::Insertion;
pub use run::{Run, simulate};
pub use segment::Segment;
pub use sequence::Tour;
pub use value::Value;
pub(crate) use visit::Visit;

#[cfg(test)]
mod tests;
