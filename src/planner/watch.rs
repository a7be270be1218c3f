//! A contender's search under the clock: it ends in time, its policy keeps to its share, and its tour is checked.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

use voltour_solver::check::check;
use voltour_solver::plan::Plan;
use voltour_solver::policy::QFunction;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, Outcome, PolicyUse, SolverName, empty_plan};
use voltour_solver::stop::StopRule;

use super::contest::Contest;
use super::part::uses_policy;
use crate::policy::{Limited, Policy};

/// The part of a search's time that the values of its policy may take.
const POLICY_PART: u32 = 2;

/// Ends a search in time, and notes when each solver in it was done.
pub(super) struct Watch<'a> {
    contest: &'a Contest,
    budget: Duration,
    from: Duration,
    policy: Option<Limited<'a>>,
    /// When the search ends; set when it begins, for compiling a large scenario is no part of it.
    until: Cell<Option<Duration>>,
    done_s: RefCell<Vec<(String, f64)>>,
    /// How the policy fared.
    pub tried: RefCell<PolicyUse>,
}

impl<'a> Watch<'a> {
    /// From now on.
    pub fn new(contest: &'a Contest, budget: Duration, policy: Option<&'a Policy>) -> Self {
        let limited = |policy: &'a Policy| {
            Limited::new(&*policy.function, &*contest.clock, budget / POLICY_PART)
        };
        Self {
            contest,
            budget,
            from: contest.clock.ran(),
            policy: policy.map(limited),
            until: Cell::new(None),
            done_s: RefCell::default(),
            tried: RefCell::new(PolicyUse::Unused),
        }
    }

    /// A contender's outcome, if the check accepts its tour. A panic in a solver is a tour refused.
    pub fn attempt(
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
            self.tried.replace(outcome.policy.clone());
            if outcome.unfinished.is_some() && outcome.plan.stops.is_empty() {
                return Err("it did not finish and has no tour".to_owned());
            }
            let broken = check(scenario, &outcome.plan);
            let broken: Vec<String> = broken.iter().take(10).map(ToString::to_string).collect();
            if broken.is_empty() { Ok(outcome) } else { Err(broken.join("; ")) }
        };
        catch_unwind(AssertUnwindSafe(judged)).unwrap_or_else(|panic| Err(message(&*panic)))
    }

    /// Time since the search began.
    pub fn elapsed_s(&self) -> f64 {
        self.contest.clock.ran().saturating_sub(self.from).as_secs_f64()
    }

    /// Of each of several contenders in one search, when it was done: seconds since the search began.
    pub fn done_s(self) -> Vec<(String, f64)> {
        self.done_s.into_inner()
    }

    fn solve(&self, scenario: &Scenario, solver: SolverName) -> Result<Outcome, String> {
        let policy = self.policy.as_ref().filter(|_| uses_policy(solver));
        let policy = policy.map(|policy| policy as &dyn QFunction);
        let options = Options { solver, seed: self.contest.seed, stop: self, policy };
        (self.contest.solve)(scenario, &options).map_err(|unavailable| unavailable.to_string())
    }
}

impl StopRule for Watch<'_> {
    fn should_stop(&self, _: u64) -> bool {
        let Contest { clock, latest, cancel, .. } = self.contest;
        // In this order: a clock of a test moves on when it is asked for the time.
        let (now, ran) = (clock.now(), clock.ran());
        let until = self.until.get().unwrap_or_else(|| {
            let until = ran + self.budget;
            self.until.set(Some(until));
            until
        });
        cancel.is_cancelled() || ran >= until || now >= *latest
    }

    fn done(&self, solver: &str) {
        self.done_s.borrow_mut().push((solver.to_owned(), self.elapsed_s()));
    }
}

fn empty(plan: Plan) -> Outcome {
    Outcome {
        plan,
        iterations: Vec::new(),
        contenders: Vec::new(),
        policy: PolicyUse::Unused,
        unfinished: None,
    }
}

fn message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("panicked: {}", text.unwrap_or("without a message"))
}
