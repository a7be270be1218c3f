//! `export`: a checkpoint's best network as an ONNX model.

use std::path::PathBuf;

use voltour_trainer::Result;
use voltour_trainer::checkpoint::Checkpoint;

/// What to write where.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The checkpoint.
    checkpoint: PathBuf,
    /// The model to write.
    model: PathBuf,
    /// Take the network of the last step, not the one that did best in validation.
    #[arg(long)]
    last: bool,
}

/// Writes the model.
pub fn run(args: Args) -> Result<()> {
    let checkpoint = Checkpoint::load(&args.checkpoint)?;
    checkpoint.model(args.last).save(&args.model)
}
