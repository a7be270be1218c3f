//! `voltour check`. Checks a plan against its scenario.

use std::path::PathBuf;
use std::process::ExitCode;

use super::{Failure, documents};

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Each broken rule is a line on standard output: JSON path, value, rule. A plan that holds prints nothing.

Exit codes:
  0  the plan holds
  1  it breaks at least one rule
  2  bad arguments, or a document that is none

Example:
  voltour check scenario.json plan.json && echo holds")]
pub struct Args {
    /// The scenario document; - is standard input
    pub scenario: PathBuf,
    /// The plan document; - is standard input
    pub plan: PathBuf,
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    if documents::is_standard(&args.scenario) && documents::is_standard(&args.plan) {
        return Err(Failure::input("only one document can come from standard input"));
    }
    let scenario = documents::scenario(&args.scenario)?;
    let plan = documents::plan(&args.plan)?;
    let broken = voltour_solver::check::check(&scenario, &plan);
    let lines: String = broken.iter().map(|rule| format!("{rule}\n")).collect();
    documents::print(&lines)?;
    Ok(if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
