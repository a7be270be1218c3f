//! How many candidates a tour can serve where time is all that runs out, one number after the other.
//!
//! That `K` stops cannot be made in time is proven directly. A tour of `K` stops takes at least what a
//! relaxed path takes, with Lagrangian prices for visiting anyone twice and for the number of stops
//! ([`Prices`]); going on from any moment is bounded by the same paths ([`Tails`]), whose hops are lower
//! bounds on real ones by interval of the moment ([`Timetable`]). Under these bounds partial tours are
//! extended stop by stop, all of one length before any longer one ([`Stages`]). With only the best of each
//! length kept this finds tours; where none had to be given up it is the proof that there is none.

mod prices;
mod proof;
mod stages;
mod tails;
#[cfg(test)]
mod tests;
mod timetable;

use prices::Prices;
pub use proof::{applies, count};
use stages::{Outcome, Stages};
use tails::Tails;
use timetable::Timetable;
