//! The contest: the solver asked for first, and the next contender whenever the independent check
//! refuses a tour or a solver fails; at last the empty tour. What holds becomes the plan.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tokio_util::sync::CancellationToken;
use voltour_solver::policy::Problem;
use voltour_solver::scenario::{Scenario, ScenarioError};
use voltour_solver::solvers::{Options, Outcome, PolicyUse, SolverName, Unavailable};

use super::part::PolicyPart;
use super::watch::Watch;
use super::{record, scenario};
use crate::clock::Clock;
use crate::policy::{ModelError, Policies, Policy};
use crate::store::{Batch, NewPlan};

/// How a contender solves: `voltour_solver::solvers::solve`, but in tests.
pub type Solve = fn(&Scenario, &Options<'_>) -> Result<Outcome, Unavailable>;

/// How a batch is planned.
#[derive(Clone, Debug)]
pub struct Contest {
    /// The solver asked for.
    pub solver: SolverName,
    /// What runs it, and the next contenders.
    pub solve: Solve,
    /// The trained policies; that of the scenario's problem is for the solvers that ask one.
    pub policies: Arc<Policies>,
    /// The seed of its search.
    pub seed: u64,
    /// How long its search takes at most; the next contenders get a part of it each.
    pub budget: Duration,
    /// When every search ends.
    pub latest: Timestamp,
    /// Tells the time.
    pub clock: Arc<dyn Clock>,
    /// Ends the search early.
    pub cancel: CancellationToken,
}

/// The part of the budget that each next contender gets.
const PART: u32 = 8;

/// Why a batch has no plan: a defect in every case.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The rules of what comes in let something pass.
    #[error("the batch is no scenario: {0}")]
    Scenario(#[from] ScenarioError),
    /// Not even the empty tour is accepted.
    #[error("the check refuses every tour: {}", .0.join("; "))]
    Refused(Vec<String>),
    /// The plan speaks of what is not in the batch, or cannot be packed.
    #[error("the plan cannot be stored: {0}")]
    Record(String),
}

/// A plan, and what part the policy had in it.
#[derive(Clone, Debug)]
pub struct Planned {
    /// What is stored.
    pub new: NewPlan,
    /// What part the policy had in it.
    pub policy: PolicyPart,
}

/// A tour that the check accepts.
pub(super) struct Winner {
    pub outcome: Outcome,
    /// Time of its search.
    pub elapsed_s: f64,
    /// Of each of several contenders, when it was done: seconds since the search began.
    pub done_s: Vec<(String, f64)>,
    /// Why earlier contenders lost.
    pub refused: Vec<String>,
    /// How the policy fared, in whichever contender asked it.
    pub tried: PolicyUse,
}

impl Winner {
    /// How long a solver took: all the time where it was alone, else from when the one before was done.
    pub fn time_of(&self, solver: &str) -> Option<f64> {
        if self.done_s.is_empty() {
            return Some(self.elapsed_s);
        }
        let own = self.done_s.iter().position(|(name, _)| name == solver)?;
        let began_s = own.checked_sub(1).map_or(0.0, |before| self.done_s[before].1);
        Some(self.done_s[own].1 - began_s)
    }
}

/// Plans a batch. It computes for as long as the budget lasts: not for an async thread.
///
/// # Errors
/// A defect.
pub fn plan(batch: &Batch, contest: &Contest) -> Result<Planned, PlanError> {
    let (document, scenario) = scenario::scenario(batch)?;
    let winner = contest.winner(&scenario)?;
    let (asked, solver) = (contest.solver, &winner.outcome.plan.solver);
    let policy = PolicyPart::of(asked, contest.policy(&scenario), &winner.tried, solver);
    let new = record::record(batch, contest, &document, &scenario, winner, &policy)?;
    Ok(Planned { new, policy })
}

impl Contest {
    /// The policy of a scenario's problem.
    fn policy(&self, scenario: &Scenario) -> Result<&Policy, &ModelError> {
        self.policies.of(Problem::of(scenario.objective))
    }

    fn winner(&self, scenario: &Scenario) -> Result<Winner, PlanError> {
        let policy = self.policy(scenario).ok();
        let (mut refused, mut tried) = (Vec::new(), PolicyUse::Unused);
        let contenders =
            [Some(self.solver), Some(SolverName::Baseline), Some(SolverName::Greedy), None];
        for (i, contender) in contenders.into_iter().enumerate() {
            let is_done = contender.is_some() && contenders[..i].contains(&contender);
            if is_done {
                continue;
            }
            let budget = if i == 0 { self.budget } else { self.budget / PART };
            let watch = Watch::new(self, budget, policy);
            let attempt = watch.attempt(scenario, contender);
            let how = watch.tried.replace(PolicyUse::Unused);
            if !matches!(how, PolicyUse::Unused | PolicyUse::Missing) {
                tried = how;
            }
            match attempt {
                Ok(mut outcome) => {
                    let elapsed_s = watch.elapsed_s();
                    outcome.plan.elapsed_s = elapsed_s;
                    let done_s = watch.done_s();
                    return Ok(Winner { outcome, elapsed_s, done_s, refused, tried });
                }
                Err(reason) => {
                    let name = contender.map_or("empty", SolverName::name);
                    tracing::error!(
                        contender = name,
                        reason,
                        "a defect: a contender has no tour that holds"
                    );
                    refused.push(format!("{name}: {reason}"));
                }
            }
        }
        Err(PlanError::Refused(refused))
    }
}
