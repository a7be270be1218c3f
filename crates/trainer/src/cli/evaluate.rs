//! `evaluate`: a model against proven optima and against the same search without learning, cell by cell.

use std::path::PathBuf;

use rayon::prelude::*;
use voltour_solver::generate::{Cell, FIRST_TEST_SEED};
use voltour_solver::instance::Instance;
use voltour_solver::policy::Problem;
use voltour_solver::scenario::Scenario;
use voltour_trainer::evaluate::{Method, Optima, Optimum, Paired, Run, Summary, Table};
use voltour_trainer::network::Network;
use voltour_trainer::onnx::Model;
use voltour_trainer::{Error, Result};

/// Which model, on what, how.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The model.
    model: PathBuf,
    /// Cells, such as k_coverage/48/3/0.45, reward/120/300000/1.0, dense/80 or mobile/20 [default: those of the
    /// paper's tables and the hard ones beyond them].
    #[arg(long, value_delimiter = ',', value_name = "CELL")]
    cells: Vec<Cell>,
    /// Ways to build a tour, `[control-]WHAT[+order[N]][+search]`, or a solver; `control-` is the same search without
    /// learning.
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "METHOD",
        default_value = "control-greedy,greedy"
    )]
    methods: Vec<Method>,
    /// Scenarios a cell, none of which any training has seen.
    #[arg(long, default_value_t = 100)]
    count: u64,
    /// Seed of the methods.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Run every scenario with so many seeds, from that one on.
    #[arg(long, default_value_t = 1, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..))]
    seeds: u16,
    /// Compare the other methods with the last one, scenario by scenario and seed by seed.
    #[arg(long)]
    paired: bool,
    /// File of the proofs so far; new ones are added.
    #[arg(long, value_name = "FILE")]
    optima: Option<PathBuf>,
    /// Seconds of processor time for each proof.
    #[arg(long, default_value_t = 10.0)]
    proof_s: f64,
    /// Seconds of processor time for each run of a solver.
    #[arg(long, default_value_t = 0.02)]
    limit_s: f64,
    /// Write the table as CSV, too.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// Prints a table in Markdown.
pub fn run(args: Args) -> Result<()> {
    if args.paired && args.methods.len() < 2 {
        let value = args.methods.iter().map(Method::to_string).collect();
        return Err(Error::Option {
            name: "methods",
            value,
            rule: "must be two or more with --paired",
        });
    }
    let model = Model::load(&args.model)?;
    let problem: Problem =
        model.metadata.problem.parse().map_err(|e| Error::format(&args.model, format!("{e}")))?;
    let network = Network::new(model.weights);
    let cells = if args.cells.is_empty() { Cell::of(problem) } else { args.cells.clone() };
    let file = args.optima.clone().unwrap_or_default();
    let mut optima =
        Optima::open(args.optima.as_deref(), args.proof_s).map_err(Error::file(&file))?;
    let mut table = Table::default();
    for cell in &cells {
        let draw = |i: u64| {
            let document =
                cell.draw(FIRST_TEST_SEED + i).map_err(|e| Error::Scenario(e.to_string()))?;
            Scenario::from_document(&document).map_err(|e| Error::Scenario(e.to_string()))
        };
        let scenarios = (0..args.count).into_par_iter().map(draw).collect::<Result<Vec<_>>>()?;
        let instances: Vec<Instance<'_>> = scenarios.par_iter().map(Instance::new).collect();
        let mut known: Vec<Optimum> = Vec::new();
        for (i, instance) in instances.iter().enumerate() {
            known.push(optima.of(&format!("{cell}:{i}"), instance).map_err(Error::file(&file))?);
        }
        measure(&args, cell, &instances, &known, &network, &mut table)?;
        eprintln!("{cell}");
    }
    println!("{}", table.markdown());
    print!("{}", table.comparisons());
    match &args.csv {
        Some(path) => std::fs::write(path, table.csv()).map_err(Error::file(path)),
        None => Ok(()),
    }
}

/// The rows of a cell. Methods run one after the other on each scenario, for one may be given the time of
/// the one before.
fn measure(
    args: &Args,
    cell: &Cell,
    instances: &[Instance<'_>],
    known: &[Optimum],
    network: &Network,
    table: &mut Table,
) -> Result<()> {
    let mut summaries = vec![Summary::default(); args.methods.len()];
    let mut pairs = vec![Paired::default(); args.methods.len().saturating_sub(1)];
    for (instance, optimum) in instances.iter().zip(known) {
        let Some(best) = optimum.objective else { continue };
        // By method, then by seed.
        let mut gaps = vec![Vec::new(); args.methods.len()];
        for i in 0..args.seeds {
            let seed = args.seed.wrapping_add(i.into());
            let mut before: Option<Run> = None;
            for (m, method) in args.methods.iter().enumerate() {
                let as_long_s = before.map_or(0.0, |run| run.seconds);
                let run = method
                    .run(instance, network, seed, args.limit_s, as_long_s)
                    .map_err(|e| Error::Scenario(e.to_string()))?;
                gaps[m].push(summaries[m].add(&run, best));
                before = Some(run);
            }
        }
        let Some((last, others)) = gaps.split_last() else { continue };
        for (other, paired) in others.iter().zip(&mut pairs) {
            paired.add(other.iter().copied().zip(last.iter().copied()));
        }
    }
    let cell = cell.to_string();
    if let Some((last, others)) = args.methods.split_last().filter(|_| args.paired) {
        for (other, paired) in others.iter().zip(pairs) {
            table.compare(&cell, &format!("{other} - {last}"), paired);
        }
    }
    for (method, summary) in args.methods.iter().zip(summaries) {
        table.push(&cell, &method.to_string(), known, summary);
    }
    Ok(())
}
