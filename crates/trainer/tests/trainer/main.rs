//! The trainer as a whole: four implementations of one network agree, learning is repeatable and learns.
#![allow(clippy::unwrap_used)]

mod evaluate;
mod gradient;
mod learning;
mod model;
mod network;
mod states;
