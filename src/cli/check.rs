//! `voltour check`. Checks a plan against its scenario.

use std::process::ExitCode;

use super::Failure;

/// Its arguments.
#[derive(Debug, clap::Args)]
pub struct Args {}

/// Runs the command.
pub fn run(_args: Args) -> Result<ExitCode, Failure> {
    Err(Failure::other("`voltour check` is not there yet"))
}
