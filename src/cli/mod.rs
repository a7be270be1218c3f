//! The command tree: each command is a file with its `Args` and its `run`. The only room that prints.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line prints")]

pub mod check;
mod command;
pub mod failure;
pub mod generate;
pub mod operator;
pub mod serve;
pub mod solve;

pub use command::{Cli, Command, run};
pub use failure::Failure;
