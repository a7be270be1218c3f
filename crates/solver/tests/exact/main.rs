//! The exact solver: whatever it claims must be true of every tour that the check accepts.
//!
//! `VOLTOUR_TRIALS` scales the tests that draw scenarios; it is the number of trials of the largest.
#![allow(clippy::unwrap_used, clippy::panic)]

#[path = "../golden/mod.rs"]
mod golden;
#[path = "../mixed/mod.rs"]
mod mixed;

mod agreement;
mod anytime;
mod deciding;
mod defects;
mod draw;
mod edge;
mod journey;
mod midsize;
mod published;
mod relabelled;
mod run;
mod subsets;
mod truth;
