//! The command line: each command is a file with its `Args` and its `run`. The only room that prints.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line prints")]

mod bar;
mod command;
mod evaluate;
mod export;
mod run;
mod train;

pub use command::{Cli, run};
