//! `train`: a training from its scenarios to its model.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use voltour_solver::instance::Instance;
use voltour_solver::policy::Problem;
use voltour_trainer::checkpoint::Checkpoint;
use voltour_trainer::dqn::{Device, Options, Pool, Training, demonstrations, trials};
use voltour_trainer::scenarios::{Split, draw, read};
use voltour_trainer::{Error, Result};

use super::run::Run;

/// What to train, on what, and how.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The problem: k_coverage, reward or mobile.
    pub problem: Problem,
    /// Directory of the checkpoint, the learning curves and the model [default: runs/PROBLEM].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Go on from the checkpoint in the directory; its options hold.
    #[arg(long)]
    pub resume: bool,
    /// Scenarios of one's own, `*.json`, instead of drawn ones; one in ten is kept for validation.
    #[arg(long, value_name = "DIR")]
    pub scenarios: Option<PathBuf>,
    /// Deployments of sensors drawn.
    #[arg(long, default_value_t = 600)]
    pub deployments: u64,
    /// Sets of requests drawn for each deployment.
    #[arg(long, default_value_t = 6)]
    pub redraws: u64,
    /// Scenarios of the validation set, before those without a proof are left out.
    #[arg(long, default_value_t = 200)]
    pub validation: u64,
    /// Iterations of the exact solver for each of these.
    #[arg(long, default_value_t = 200_000)]
    pub proof: u64,
    /// Gradient steps between two validations, each with a checkpoint.
    #[arg(long, default_value_t = 500)]
    pub validate_every: u64,
    /// Where gradients are computed.
    #[arg(long, value_enum, default_value_t = Device::Cpu)]
    pub device: Device,
    /// Threads; 0 for one a core.
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// The hyper-parameters.
    #[command(flatten)]
    pub options: Options,
}

/// Trains until all steps are taken or the user interrupts.
pub fn run(args: Args) -> Result<()> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.threads).build_global();
    pool.map_err(|e| Error::Device(e.to_string()))?;
    let interrupted = Arc::new(AtomicBool::new(false));
    let heard = Arc::clone(&interrupted);
    ctrlc::set_handler(move || heard.store(true, Ordering::Relaxed))
        .map_err(|e| Error::Device(e.to_string()))?;

    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(args.problem.name()));
    let path = out.join("checkpoint.safetensors");
    let checkpoint = if args.resume { Some(Checkpoint::load(&path)?) } else { None };
    let options =
        checkpoint.as_ref().map_or(args.options.clone(), |c| c.run.options.clone()).checked()?;

    let (problem, seed) = (args.problem, options.seed);
    let (training, validation) = match &args.scenarios {
        Some(directory) => {
            let all = read(directory, problem)?.into_iter().enumerate();
            let (held, rest): (Vec<_>, Vec<_>) = all.partition(|(i, _)| i % 10 == 0);
            let bare =
                |all: Vec<(usize, _)>| all.into_iter().map(|(_, scenario)| scenario).collect();
            (bare(rest), bare(held))
        }
        None => (
            draw(problem, Split::Training, seed, args.deployments, args.redraws)?,
            draw(problem, Split::Validation, 0, args.validation, 1)?,
        ),
    };
    let training: Vec<_> = training.par_iter().map(Instance::new).collect();
    let validation: Vec<_> = validation.par_iter().map(Instance::new).collect();
    let trials = trials(&validation, problem, args.proof);
    let pool = Pool::new(&training, problem)?;
    eprintln!("{} scenarios to train on, {} to validate on", pool.len(), trials.len());

    let shown = if options.demonstrations > 0.0 {
        demonstrations(&training, problem, args.proof, seed)
    } else {
        Vec::new()
    };
    let mut training = match &checkpoint {
        Some(checkpoint) => {
            let learner = checkpoint.learner(args.device)?;
            Training::resume(options, pool, learner, checkpoint.run.rounds)?
        }
        None => Training::new(options, pool, args.device)?,
    };
    training.demonstrate(shown);
    Run::new(training, trials, problem, out, checkpoint).go(args.validate_every, &interrupted)
}
