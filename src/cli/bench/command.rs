//! Which bench.

use std::process::ExitCode;

use super::{paper, public};
use crate::cli::Failure;

/// What is compared.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// The tables of the paper: its algorithms and ours on freshly drawn scenarios
    Paper(paper::Args),
    /// Public instances with best known values
    Public(public::Args),
}

/// Runs the command.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Paper(args) => paper::run(args),
        Command::Public(args) => public::run(args),
    }
}
