//! Writes a model with random parameters and, as JSON, batches with the values that the trainer computes, for
//! `tests/onnx/agree.py`: `cargo run -p voltour-trainer --example onnx_values -- DIRECTORY`.
#![allow(clippy::print_stderr, reason = "a command line prints")]

use std::error::Error;
use std::path::Path;

use serde_json::json;
use voltour_solver::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use voltour_solver::instance::Instance;
use voltour_solver::policy::{Batch, Encoding, Problem, QFunction};
use voltour_solver::scenario::Scenario;
use voltour_trainer::dqn::Play;
use voltour_trainer::network::{Network, Shape, Weights};
use voltour_trainer::onnx::{Metadata, Model};

fn main() -> Result<(), Box<dyn Error>> {
    let directory = std::env::args().nth(1).ok_or("a directory is missing")?;
    let directory = Path::new(&directory);
    let weights = Weights::random(Shape::default(), 1);
    let metadata = Metadata {
        problem: Problem::KCoverage.name().to_owned(),
        training: json!({ "steps": 0 }).to_string(),
        evaluation: json!({}).to_string(),
    };
    Model { weights: weights.clone(), metadata }.save(&directory.join("model.onnx"))?;
    let network = Network::new(weights);
    let mut batches = Vec::new();
    for seed in 0..4 {
        let document = match seed {
            0 => k_coverage(&KCoverage { sensors: 48, k: 2, ..KCoverage::default() }, seed)?,
            1 => reward(&Reward { sensors: 60, alpha: 1.0, ..Reward::default() }, seed)?,
            2 => mobile(&Mobile::default(), seed)?,
            _ => k_coverage(
                &KCoverage { sensors: 40, k: 2, alpha: 0.2, ..KCoverage::default() },
                seed,
            )?,
        };
        let scenario = Scenario::from_document(&document)?;
        let batch = Batch::pack(&states(&scenario));
        let q = network.values(&batch)?;
        let Batch { states, rows, nodes, edges, mask } = batch;
        batches.push(json!({
            "states": states, "rows": rows, "nodes": nodes, "edges": edges, "mask": mask, "q": q
        }));
    }
    std::fs::write(directory.join("values.json"), serde_json::to_vec(&batches)?)?;
    eprintln!("wrote {} batches", batches.len());
    Ok(())
}

/// The states of an episode that always takes the first action.
fn states(scenario: &Scenario) -> Vec<Encoding> {
    let instance = Instance::new(scenario);
    let mut play = Play::new(&instance, Problem::of(scenario.objective));
    let mut states = Vec::new();
    while !play.episode.is_over() {
        states.push(play.encode());
        play.episode.act(0);
    }
    states
}
