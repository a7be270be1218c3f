//! `voltour serve`: runs the service.

use std::path::PathBuf;
use std::process::ExitCode;

use super::Failure;

/// Its arguments.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// TOML file with the configuration; every key has a default
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Play a base station and a charger against the service, in fast motion
    #[arg(long)]
    pub demo: bool,
    /// With --demo: stop after so many departures instead of at Ctrl-C
    #[arg(long, value_name = "N", requires = "demo")]
    pub demo_departures: Option<u32>,
}

/// Runs the command.
pub fn run(_args: Args) -> Result<ExitCode, Failure> {
    Err(Failure::other("`voltour serve` is not there yet"))
}
