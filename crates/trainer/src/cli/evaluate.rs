//! `evaluate`: a model against proven optima.

use std::path::PathBuf;

use voltour_solver::instance::Instance;
use voltour_solver::policy::Problem;
use voltour_trainer::dqn::{trials, validate};
use voltour_trainer::network::Network;
use voltour_trainer::onnx::Model;
use voltour_trainer::scenarios::{Split, draw, read};
use voltour_trainer::{Error, Result};

/// Which model, on what.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The model.
    model: PathBuf,
    /// Scenarios of one's own, `*.json`, instead of drawn ones.
    #[arg(long, value_name = "DIR")]
    scenarios: Option<PathBuf>,
    /// Scenarios drawn.
    #[arg(long, default_value_t = 200)]
    count: u64,
    /// Seed of the scenarios.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Iterations of the exact solver for each; what it does not prove by then is left out.
    #[arg(long, default_value_t = 200_000)]
    proof: u64,
}

/// Prints the score of one greedy roll-out as JSON.
pub fn run(args: Args) -> Result<()> {
    let model = Model::load(&args.model)?;
    let problem: Problem =
        model.metadata.problem.parse().map_err(|e| Error::format(&args.model, format!("{e}")))?;
    let scenarios = match &args.scenarios {
        Some(directory) => read(directory, problem)?,
        None => draw(problem, Split::Test, args.seed, args.count, 1)?,
    };
    let instances: Vec<Instance<'_>> = scenarios.iter().map(Instance::new).collect();
    let trials = trials(&instances, problem, args.proof);
    let score = validate(&Network::new(model.weights), &trials);
    println!("{}", serde_json::to_string_pretty(&score).unwrap_or_default());
    Ok(())
}
