//! The commands, and the one place where a failure becomes a line and an exit code.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use voltour_trainer::{Error, Result};

use super::{evaluate, export, train};

/// Trains, evaluates and exports the policies that plan voltour's tours.
#[derive(Debug, Parser)]
#[command(name = "voltour-train", version, after_long_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  Train a policy, with its checkpoint, learning curves and best model in runs/k_coverage:
    voltour-train train k_coverage --out runs/k_coverage

  Go on after an interruption:
    voltour-train train k_coverage --out runs/k_coverage --resume

  Train on scenarios of one's own:
    voltour-train train reward --scenarios my-scenarios

  Say how good a model is on scenarios that no training has seen:
    voltour-train evaluate runs/k_coverage/model.onnx

  Take the network of a checkpoint as it is now:
    voltour-train export runs/k_coverage/checkpoint.safetensors now.onnx";

#[derive(Debug, Subcommand)]
enum Command {
    /// Train a policy for a problem
    Train(Box<train::Args>),
    /// Measure a model against proven optima
    Evaluate(Box<evaluate::Args>),
    /// Write the best network of a checkpoint as an ONNX model
    Export(export::Args),
}

/// Runs a command to its exit code: 2 for bad input, 1 for what else went wrong.
pub fn run(cli: Cli) -> ExitCode {
    let done: Result<()> = match cli.command {
        Command::Train(args) => train::run(*args),
        Command::Evaluate(args) => evaluate::run(*args),
        Command::Export(args) => export::run(args),
    };
    let Err(error) = done else { return ExitCode::SUCCESS };
    eprintln!("voltour-train: {error}");
    match error {
        Error::Option { .. } | Error::Format { .. } => ExitCode::from(2),
        _ => ExitCode::FAILURE,
    }
}
