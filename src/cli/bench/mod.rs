//! `voltour bench`: the algorithms side by side.

mod bar;
mod command;
mod paper;
mod public;
mod shared;

pub use command::{Command, run};
