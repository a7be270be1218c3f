//! The command tree: each command is a file with its `Args` and its `run`. The only room that prints.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line prints")]

pub mod backup;
pub mod bench;
pub mod check;
mod command;
pub mod config;
mod database;
mod documents;
pub mod explain;
pub mod failure;
pub mod generate;
mod input;
pub mod operator;
mod out;
pub mod pages;
mod paper;
pub mod policies;
mod pretty;
pub mod serve;
pub mod solve;
mod stopwatch;
pub mod token;

pub use command::{Cli, Command, run};
pub use database::Database;
pub use failure::Failure;
pub use out::say;
