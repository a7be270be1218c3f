//! The contest: the solver asked for first, and the next contender whenever the independent check
//! refuses a tour or a solver fails; at last the empty tour. What holds becomes the plan.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tokio_util::sync::CancellationToken;
use voltour_solver::check::check;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Scenario, ScenarioError};
use voltour_solver::solvers::{Options, Outcome, SolverName, Unavailable, empty_plan};
use voltour_solver::stop::StopRule;

use super::{record, scenario};
use crate::clock::{Clock, plus, seconds};
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

/// A tour that the check accepts.
pub(super) struct Winner {
    pub outcome: Outcome,
    /// Time of its search.
    pub elapsed_s: f64,
    /// Of each of several contenders, when it was done: seconds since the search began.
    pub done_s: Vec<(String, f64)>,
    /// Why earlier contenders lost.
    pub refused: Vec<String>,
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
pub fn plan(batch: &Batch, contest: &Contest) -> Result<NewPlan, PlanError> {
    let (document, scenario) = scenario::scenario(batch)?;
    let winner = contest.winner(&scenario)?;
    record::record(batch, contest, &document, &scenario, winner)
}

impl Contest {
    fn winner(&self, scenario: &Scenario) -> Result<Winner, PlanError> {
        let mut refused = Vec::new();
        let contenders =
            [Some(self.solver), Some(SolverName::Baseline), Some(SolverName::Greedy), None];
        for (i, contender) in contenders.into_iter().enumerate() {
            if contender.is_some() && contenders.iter().take(i).any(|other| *other == contender) {
                continue;
            }
            let from = self.clock.now();
            let budget = if i == 0 { self.budget } else { self.budget / PART };
            let watch = Watch {
                contest: self,
                budget,
                from,
                until: Cell::new(None),
                done_s: RefCell::default(),
            };
            match watch.attempt(scenario, contender) {
                Ok(mut outcome) => {
                    let elapsed_s = seconds(from, self.clock.now()).max(0.0);
                    outcome.plan.elapsed_s = elapsed_s;
                    let done_s = watch.done_s.into_inner();
                    return Ok(Winner { outcome, elapsed_s, done_s, refused });
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

/// A contender's search under the clock: ends it in time, and notes when each solver in it was done.
struct Watch<'a> {
    contest: &'a Contest,
    budget: Duration,
    from: Timestamp,
    /// When the search ends; set when it begins, for compiling a large scenario is no part of it.
    until: Cell<Option<Timestamp>>,
    done_s: RefCell<Vec<(String, f64)>>,
}

impl StopRule for Watch<'_> {
    fn should_stop(&self, _: u64) -> bool {
        let now = self.contest.clock.now();
        let until = self.until.get().unwrap_or_else(|| {
            let until = plus(now, self.budget).min(self.contest.latest);
            self.until.set(Some(until));
            until
        });
        self.contest.cancel.is_cancelled() || now >= until
    }

    fn done(&self, solver: &str) {
        let after_s = seconds(self.from, self.contest.clock.now()).max(0.0);
        self.done_s.borrow_mut().push((solver.to_owned(), after_s));
    }
}

impl Watch<'_> {
    /// A contender's outcome, if the check accepts its tour. A panic in a solver is a tour refused.
    fn attempt(
        &self,
        scenario: &Scenario,
        contender: Option<SolverName>,
    ) -> Result<Outcome, String> {
        let run = || match contender {
            Some(solver) => self.solve(scenario, solver),
            None => Ok(empty(empty_plan(scenario))),
        };
        let judged = || {
            let outcome = run()?;
            let broken = check(scenario, &outcome.plan);
            let broken: Vec<String> = broken.iter().take(10).map(ToString::to_string).collect();
            if broken.is_empty() { Ok(outcome) } else { Err(broken.join("; ")) }
        };
        catch_unwind(AssertUnwindSafe(judged)).unwrap_or_else(|panic| Err(message(&*panic)))
    }

    fn solve(&self, scenario: &Scenario, solver: SolverName) -> Result<Outcome, String> {
        let options = Options { solver, seed: self.contest.seed, stop: self, policy: None };
        (self.contest.solve)(scenario, &options).map_err(|unavailable| unavailable.to_string())
    }
}

fn empty(plan: Plan) -> Outcome {
    Outcome { plan, iterations: Vec::new(), contenders: Vec::new() }
}

fn message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("panicked: {}", text.unwrap_or("without a message"))
}
