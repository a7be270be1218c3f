//! Entry point, and the only place that ends the process.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    voltour::cli::run(voltour::cli::Cli::parse())
}
