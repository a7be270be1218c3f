//! `voltour bench public`.

use std::path::PathBuf;
use std::process::ExitCode;

use voltour_solver::solvers::SolverName;

use super::shared::{Shared, failure, trained};
use crate::bench::{BenchError, Entrant, Public};
use crate::cli::{Failure, documents, solve};

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The folder holds scenario documents and a best.csv with the columns file, objective, best_known, proven (yes or
no) and source. A gap marked by ! is on the better side of a value that is said to be proven.

Every run is kept in runs.csv of --out as soon as it is done: interrupt the command, and give it again to go on.

Exit codes:
  0  the table is written
  2  bad arguments, or a document that breaks a rule of the format
  3  a plan does not hold (a defect)

Example:
  voltour bench public instances --solvers baseline,exact")]
pub struct Args {
    /// The folder
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Which solvers
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        default_value = "greedy,dqn,baseline,auto,exact"
    )]
    pub solvers: Vec<String>,
    /// Limits, seed, threads.
    #[command(flatten)]
    pub shared: Shared,
    /// Folder of the runs and the table
    #[arg(long, value_name = "DIR", default_value = "bench-public")]
    pub out: PathBuf,
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let solvers: Result<Vec<SolverName>, Failure> =
        args.solvers.iter().map(|name| solve::solver(name)).collect();
    let entrants: Vec<Entrant> = solvers?.into_iter().map(Entrant::plain).collect();
    let public = Public::read(&args.folder).map_err(failure)?;
    let log = args.shared.work(&args.out, &public.jobs(&entrants), &trained()?)?;
    let text = public.markdown(log.runs(), &entrants);
    let path = args.out.join("public.md");
    std::fs::write(&path, &text).map_err(BenchError::file(&path)).map_err(failure)?;
    documents::print(&text)?;
    Ok(ExitCode::SUCCESS)
}
