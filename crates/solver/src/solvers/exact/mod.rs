//! Proof: the best tour with a bound that shows it, or that there is none.
//!
//! One machine serves every combination of objective and constraints. A model states what is proven, with
//! limits as wide as the check lets them be. Lower bounds come from relaxed paths (ng-paths, layered by
//! the scarcest resource) with Lagrangian prizes for what must be served, and with a price of energy where
//! energy makes the layers; they become tighter round by round, as paths remember more neighbours, count
//! more demands and keep finer times. Under these bounds a best-first search over labels, with dominance,
//! either ends, which is the proof, or gives a bound.
//!
//! How many can be served where time is all that runs out is asked in another way first (`counting`):
//! time is then the cost, and a tour of one stop more is what must not exist.

mod bits;
mod clusters;
mod counting;
mod effort;
#[cfg(test)]
mod effort_tests;
mod fixing;
mod incumbent;
mod knapsack;
#[cfg(test)]
mod knapsack_tests;
mod label;
mod layers;
mod layout;
mod memory;
mod moats;
mod model;
mod multipliers;
mod network;
mod patterns;
#[cfg(test)]
mod patterns_tests;
mod places;
mod prices;
mod pricing;
mod prove;
mod prover;
mod queue;
#[cfg(test)]
mod queue_tests;
mod quick;
#[cfg(test)]
mod quick_tests;
mod refine;
mod relaxation;
#[cfg(test)]
mod relaxation_tests;
mod search;
#[cfg(test)]
mod search_tests;
mod solve;
mod spanning;
mod tally;
mod timetable;
mod turns;
mod verdict;

pub(super) use effort::Effort;
use incumbent::Incumbent;
use model::{Aim, Model};
use places::Places;
use prove::prove;
pub use quick::quick_bound;
pub(super) use solve::solve;
pub use verdict::{Verdict, decide};
