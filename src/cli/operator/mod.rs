//! The operator's commands: they do over gRPC, against a running service, what its clients do.

use std::process::ExitCode;

use clap::Subcommand;

use super::Failure;

/// One a file.
#[derive(Debug, Subcommand)]
pub enum Command {}

/// Runs the command.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {}
}
