//! The trained policies on the command line: `--policy-folder`, `--model`, and `voltour policy list`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use voltour_solver::policy::Problem;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::SolverName;

use super::{Failure, documents};
use crate::policy::{self, Fault, ModelError, Policies, Policy};

/// Which policy a solver gets.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Choice {
    /// Trained policy (ONNX), for the solvers auto and dqn [default: the one in this binary]
    #[arg(long, value_name = "FILE", conflicts_with = "policy_folder")]
    pub model: Option<PathBuf>,
    /// Folder with trained policies, k_coverage.onnx, reward.onnx, mobile.onnx, in place of those in this binary
    #[arg(long, value_name = "DIR")]
    pub policy_folder: Option<PathBuf>,
    /// No trained policy: the plan that a policy which failed left to the other solvers
    #[arg(long, conflicts_with_all = ["model", "policy_folder"])]
    pub no_policy: bool,
}

impl Choice {
    /// Whether a solver that asks no policy was given one by name.
    pub(super) fn check(&self, solver: SolverName) -> Result<(), Failure> {
        let uses_one = matches!(solver, SolverName::Auto | SolverName::Dqn);
        match (&self.model, &self.policy_folder) {
            _ if uses_one => Ok(()),
            (Some(path), _) => Err(unused("--model", path)),
            (_, Some(path)) => Err(unused("--policy-folder", path)),
            (None, None) => Ok(()),
        }
    }

    /// The policy for a scenario: what was named must be good; without a name, `auto` does without where the
    /// binary has none, and `dqn` cannot.
    pub(super) fn policy(
        &self,
        solver: SolverName,
        scenario: &Scenario,
    ) -> Result<Option<Policy>, Failure> {
        if self.no_policy {
            return Ok(None);
        }
        let problem = Problem::of(scenario.objective);
        let found = match (solver, self) {
            (SolverName::Auto | SolverName::Dqn, Self { model: Some(path), .. }) => {
                policy::file(path, Some(problem)).map_err(|error| named("--model", &error))?
            }
            (SolverName::Auto | SolverName::Dqn, Self { policy_folder: Some(folder), .. }) => {
                let policies = Policies::load(Some(folder));
                let found =
                    policies.of(problem).map_err(|error| named("--policy-folder", error))?;
                found.clone()
            }
            (SolverName::Dqn, _) => {
                let without = |error: ModelError| {
                    Failure::input(format!("--solver dqn: {error}; name one by --model"))
                };
                policy::embedded(problem).map_err(without)?
            }
            (SolverName::Auto, _) => match policy::embedded(problem) {
                Err(ModelError { fault: Fault::Missing, .. }) => return Ok(None),
                found => found.map_err(|error| Failure::other(format!("defect: {error}")))?,
            },
            _ => return Ok(None),
        };
        Ok(Some(found))
    }
}

fn unused(option: &str, path: &Path) -> Failure {
    let path = path.display().to_string();
    Failure::input(format!("{option} {path:?}: only the solvers auto and dqn use a trained policy"))
}

fn named(option: &str, error: &ModelError) -> Failure {
    Failure::input(format!("{option}: {error}"))
}

/// What to do with the policies.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// List them: name, where it came from, SHA-256, features, how it was trained and how good it is
    List {
        /// Folder with trained policies in place of those in this binary
        #[arg(long, value_name = "DIR")]
        policy_folder: Option<PathBuf>,
    },
}

/// Runs the command: 0 where every problem has its policy, 1 otherwise.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    let Command::List { policy_folder } = command;
    let policies = Policies::load(policy_folder.as_deref());
    let text: String = policies.iter().map(|(problem, policy)| entry(problem, policy)).collect();
    documents::print(&text)?;
    let is_whole = policies.iter().all(|(_, policy)| policy.is_ok());
    Ok(if is_whole { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn entry(problem: Problem, policy: Result<&Policy, &ModelError>) -> String {
    let about = match policy {
        Ok(policy) => &policy.about,
        Err(error) => return format!("{problem}\n  none: {error}\n"),
    };
    let mut text =
        format!("{problem}\n  name        {}\n  source      {}\n", about.name, about.source);
    text += &format!("  sha256      {}\n  features    {}\n", about.digest, about.feature_version);
    for (name, said) in [("training", &about.training), ("evaluation", &about.evaluation)] {
        if !said.is_empty() {
            text +=
                &format!("  {name:<12}{}\n", said.split_whitespace().collect::<Vec<_>>().join(" "));
        }
    }
    text
}
