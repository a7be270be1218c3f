//! `voltour solve`. Plans one tour: a scenario document in, a plan document out, checked before it is
//! shown.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::plan::Plan;
use voltour_solver::policy::QFunction;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, PaperOptions, PolicyUse, SolverName, solve_with};
use voltour_solver::stop::StopRule;

use super::paper::{Paper, tell};
use super::policies::Choice;
use super::stopwatch::Stopwatch;
use super::{Failure, documents, pretty};
use crate::clock::SystemClock;
use crate::policy::{Limited, Policy};
use crate::svg;

/// Where neither a time nor a number of iterations is given.
const DEFAULT_LIMIT: Duration = Duration::from_secs(1);

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Solvers: auto (what the service runs), baseline, exact, dqn, greedy, nearest, random, and the
comparison algorithms: acs and dp for min_distance, mst and cmst for max_reward, app for max_reward
and max_count. Of these dp and app show no tour where a limit ends them before they are finished.

Exit codes:
  0  the tour keeps every constraint
  1  no feasible tour was found, or there is none; the plan says which, and what it breaks
  2  bad arguments, or a scenario that breaks a rule of the format
  3  the plan could not be written, or did not pass the check (a defect)

Examples:
  voltour solve scenario.json
  voltour solve scenario.json --time-limit 250ms -o plan.json --svg plan.svg
  voltour generate reward --seed 7 | voltour solve - --iterations 1000")]
pub struct Args {
    /// The scenario document; - is standard input
    pub scenario: PathBuf,
    /// The solver
    #[arg(long, value_name = "NAME", default_value = "auto")]
    pub solver: String,
    /// Stop after this time, such as 250ms, 1s or 2m [default: 1s, unless --iterations is given]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub time_limit: Option<Duration>,
    /// Stop after so many iterations: the repeatable rule. With --time-limit, whichever comes first
    #[arg(long, value_name = "N")]
    pub iterations: Option<u64>,
    /// Seed of every random choice
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// The trained policy.
    #[command(flatten)]
    pub policy: Choice,
    /// The comparison algorithms.
    #[command(flatten)]
    pub paper: Paper,
    /// Also draw the plan into this file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write the plan into this file instead of standard output
    #[arg(short, long, value_name = "PLAN")]
    pub output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let solver = solver(&args.solver)?;
    args.policy.check(solver)?;
    if let Some(svg) = args.svg.as_deref().filter(|svg| documents::is_standard(svg)) {
        return Err(Failure::input(format!("--svg {}: must be a file", svg.display())));
    }
    let limits = Limits::new(args.time_limit, args.iterations, DEFAULT_LIMIT);
    let scenario = documents::scenario(&args.scenario)?;
    let policy = args.policy.policy(solver, &scenario)?;
    let paper = args.paper.options();
    let plan = Planning { solver, seed: args.seed, limits, policy, paper }.plan(&scenario)?;
    // The picture first: where it cannot be written, there is no plan on standard output either.
    if let Some(path) = &args.svg {
        documents::write(Some(path), &svg::picture(&scenario, &plan))?;
    }
    documents::write(args.output.as_deref(), &pretty::json(&plan)?)?;
    Ok(if plan.status.is_feasible() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// The solver of that name.
pub(super) fn solver(name: &str) -> Result<SolverName, Failure> {
    name.parse().map_err(|error| {
        let known = SolverName::ALL.map(SolverName::name).join(", ");
        Failure::input(format!("--solver: {error}; known: {known}"))
    })
}

/// How to plan.
pub(super) struct Planning {
    pub solver: SolverName,
    pub seed: u64,
    pub limits: Limits,
    pub policy: Option<Policy>,
    pub paper: PaperOptions,
}

impl Planning {
    /// Solves and checks.
    pub fn plan(self, scenario: &Scenario) -> Result<Plan, Failure> {
        let Self { solver, seed, limits, policy, paper } = self;
        let watch = Stopwatch::start();
        let clock = SystemClock;
        let limited = policy
            .as_ref()
            .map(|policy| Limited::new(&*policy.function, &clock, limits.policy_share(solver)));
        let policy = limited.as_ref().map(|policy| policy as &dyn QFunction);
        let solved = limits.within(|stop| {
            let options = Options { solver, seed, stop, policy };
            solve_with(&Instance::new(scenario), &options, &paper)
        });
        let outcome = solved.map_err(|error| Failure::input(format!("--solver: {error}")))?;
        warn(&outcome.policy);
        tell(solver.name(), outcome.unfinished);
        let mut plan = outcome.plan;
        plan.elapsed_s = watch.elapsed().as_secs_f64();
        let broken = check(scenario, &plan);
        if broken.is_empty() { Ok(plan) } else { Err(refused(&plan.solver, &broken)) }
    }
}

/// A policy that broke down is no failure, for the tour holds without it; but whoever asked should know.
fn warn(policy: &PolicyUse) {
    if let PolicyUse::Failed(error) = policy {
        eprintln!("voltour: the policy was not used: {error}");
    }
}

/// A plan that does not hold is never shown: it is a defect of the solver or of the checker.
fn refused(solver: &str, broken: &[impl std::fmt::Display]) -> Failure {
    const MOST: usize = 5;
    let first =
        format!("defect: the plan of {solver} breaks {} rules; please report it", broken.len());
    let rules = broken.iter().take(MOST).map(|rule| format!("defect: {rule}"));
    Failure { code: documents::BROKEN, lines: std::iter::once(first).chain(rules).collect() }
}

/// When to stop: by the clock, by iterations, or by whichever comes first.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    time: Option<Duration>,
    iterations: Option<u64>,
}

impl Limits {
    /// What the arguments say, or the time that holds where they say nothing.
    pub fn new(time: Option<Duration>, iterations: Option<u64>, default: Duration) -> Self {
        Self { time: time.or_else(|| iterations.is_none().then_some(default)), iterations }
    }

    /// One of so many equal shares of the time.
    pub fn share(self, of: u32) -> Self {
        Self { time: self.time.map(|time| time / of), ..self }
    }

    /// The part of the time that what a policy does may take: half of it where others come after it.
    fn policy_share(self, solver: SolverName) -> Duration {
        let parts = if solver == SolverName::Dqn { 1 } else { 2 };
        self.time.map_or(Duration::MAX, |time| time / parts)
    }

    /// What is left after some time.
    pub fn after(self, spent: Duration) -> Self {
        Self { time: self.time.map(|time| time.saturating_sub(spent)), ..self }
    }

    /// Searches from now on within the limits.
    pub fn within<T>(self, search: impl FnOnce(&dyn StopRule) -> T) -> T {
        let watch = Stopwatch::start();
        search(&|done: u64| {
            self.iterations.is_some_and(|most| done >= most)
                || self.time.is_some_and(|limit| watch.elapsed() >= limit)
        })
    }
}

/// Such as `250ms`, `1s`, `1m 30s`.
pub(super) fn time(text: &str) -> Result<Duration, String> {
    const RULE: &str = "must be a time such as 250ms, 1s or 2m";
    let time: jiff::SignedDuration = text.parse().map_err(|_| RULE.to_owned())?;
    Duration::try_from(time).map_err(|_| RULE.to_owned())
}
