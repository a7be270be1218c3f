//! The explainer: says of every plan why it is as it is, after the tour is out and beside everything else.
//! It has no queue of its own: it goes by what the database lacks, so that a restart, an upgrade and a
//! new plan are the same to it. Knows the store and the library of explanations, not the scheduler.

#[cfg(test)]
mod tests;
mod work;
mod worker;

pub use worker::{Explainer, Settings};
