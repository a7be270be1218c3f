//! The operator's part of the command tree.

use std::process::ExitCode;

use clap::Subcommand;

use super::{charger, depart, health, network, request, tour};
use crate::cli::Failure;
use crate::cli::serve::block_on;

/// One a file.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Register networks with a running service, and look at them
    #[command(subcommand)]
    Network(network::Command),
    /// Submit charging requests to a running service, and follow them
    #[command(subcommand)]
    Request(request::Command),
    /// Announce a departure: its batch closes, and its tour is planned
    Depart(Box<depart::Args>),
    /// Fetch tours from a running service
    #[command(subcommand)]
    Tour(tour::Command),
    /// Tell a running service what became of a charger
    #[command(subcommand)]
    Charger(charger::Command),
    /// Ask whether a running service takes calls, by the exit code
    Health(Box<health::Args>),
}

/// Runs a command.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    block_on(async {
        match command {
            Command::Network(command) => network::run(command).await,
            Command::Request(command) => request::run(command).await,
            Command::Depart(args) => depart::run(*args).await,
            Command::Tour(command) => tour::run(command).await,
            Command::Charger(command) => charger::run(command).await,
            Command::Health(args) => health::run(*args).await,
        }
    })
}
