//! `voltour explain`. Says why a plan is as it is, and what would make it better.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use voltour_solver::check::check;
use voltour_solver::explain::{Explanation, explain};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::PaperOptions;

use super::policies::Choice;
use super::solve::{Limits, Planning, solver, time};
use super::stopwatch::Stopwatch;
use super::{Failure, documents, pretty};

/// Where neither a time nor a number of iterations is given.
const DEFAULT_LIMIT: Duration = Duration::from_secs(5);
/// The share of the time that goes to solving where there is no plan yet.
const SOLVING: u32 = 4;

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Without PLAN the scenario is solved first, within a quarter of the time or as many iterations. The text says, where
no tour keeps every constraint, which of them contradict each other; for each request why it is or is
not served; and what the next change of capacity, time span, speed or a deadline would buy.

Exit codes:
  0  the tour keeps every constraint
  1  no feasible tour was found, or there is none; or PLAN does not hold
  2  bad arguments, or a document that breaks a rule of its format
  3  the explanation could not be written

Examples:
  voltour explain scenario.json
  voltour explain scenario.json plan.json --format json -o explanation.json
  voltour generate k_coverage --seed 7 | voltour explain - --iterations 10000")]
pub struct Args {
    /// The scenario document; - is standard input
    pub scenario: PathBuf,
    /// The plan document; - is standard input
    pub plan: Option<PathBuf>,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Stop after this time, such as 250ms, 1s or 2m [default: 5s, unless --iterations is given]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub time_limit: Option<Duration>,
    /// Stop after so many iterations: the repeatable rule. With --time-limit, whichever comes first
    #[arg(long, value_name = "N")]
    pub iterations: Option<u64>,
    /// The solver, where there is no PLAN
    #[arg(long, value_name = "NAME", default_value = "auto", conflicts_with = "plan")]
    pub solver: String,
    /// The trained policy, where there is no PLAN.
    #[command(flatten)]
    pub policy: Choice,
    /// Seed of every random choice
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// Write the explanation into this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// How an explanation is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// For people.
    Text,
    /// The document voltour/explanation/1.
    Json,
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let standard = |path: &PathBuf| documents::is_standard(path);
    if standard(&args.scenario) && args.plan.as_ref().is_some_and(standard) {
        return Err(Failure::input("only one document can come from standard input"));
    }
    let solver = solver(&args.solver)?;
    args.policy.check(solver)?;
    let limits = Limits::new(args.time_limit, args.iterations, DEFAULT_LIMIT);
    let scenario = documents::scenario(&args.scenario)?;
    let watch = Stopwatch::start();
    let plan = match &args.plan {
        Some(path) => held(&scenario, documents::plan(path)?)?,
        None => {
            let limits = limits.share(SOLVING);
            let policy = args.policy.policy(solver, &scenario)?;
            Planning { solver, seed: args.seed, limits, policy, paper: PaperOptions::default() }
                .plan(&scenario)?
        }
    };
    let limits = limits.after(watch.elapsed());
    let explanation = limits.within(|stop| explain(&scenario, &plan, args.seed, stop));
    documents::write(args.output.as_deref(), &text(&explanation, args.format)?)?;
    Ok(if explanation.status.is_feasible() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn text(explanation: &Explanation, format: Format) -> Result<String, Failure> {
    match format {
        Format::Text => Ok(explanation.to_string()),
        Format::Json => pretty::json(explanation),
    }
}

/// The plan, if it holds: what is not so cannot be explained.
fn held(scenario: &Scenario, plan: Plan) -> Result<Plan, Failure> {
    let broken = check(scenario, &plan);
    if broken.is_empty() {
        return Ok(plan);
    }
    let first = format!("the plan breaks {} rules and is not explained", broken.len());
    let lines = std::iter::once(first).chain(broken.iter().map(ToString::to_string));
    Err(Failure { code: 1, lines: lines.collect() })
}
