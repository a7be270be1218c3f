//! The paper's comparison algorithms against the optimum, against enumeration, and against what they promise.
#![allow(clippy::unwrap_used, clippy::panic)]

#[path = "../mixed/mod.rs"]
mod mixed;

mod colony;
mod counted;
mod every;
mod programme;
mod rewarded;
mod run;
