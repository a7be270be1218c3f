//! `voltour solve`. Plans one tour: a scenario document in, a plan document out.

use std::process::ExitCode;

use super::Failure;

/// Its arguments.
#[derive(Debug, clap::Args)]
pub struct Args {}

/// Runs the command.
pub fn run(_args: Args) -> Result<ExitCode, Failure> {
    Err(Failure::other("`voltour solve` is not there yet"))
}
