//! [`solve`]: which solver, on which scenario, until when.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::plan_of::plan_of;
use super::{
    Budget, PaperOptions, SolverName, Unfinished, auto, baseline, dqn, exact, greedy, paper, random,
};
use crate::instance::Instance;
use crate::plan::{Plan, Status};
use crate::policy::guided::Effort;
use crate::policy::{Problem, QError, QFunction};
use crate::scenario::{Objective, Scenario};
use crate::stop::StopRule;
use crate::tolerance::tolerance;
use crate::tour::{Tour, Value};

/// How to solve.
pub struct Options<'a> {
    /// By which solver.
    pub solver: SolverName,
    /// Seed of every random choice.
    pub seed: u64,
    /// When to end at the latest.
    pub stop: &'a dyn StopRule,
    /// The trained policy of the scenario's problem, where there is one; `dqn` needs it, `auto` uses it.
    pub policy: Option<&'a dyn QFunction>,
}

/// What a solve gave.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The plan; its `elapsed_s` is 0, for the host knows the time.
    pub plan: Plan,
    /// Iterations of each phase, in the order of the phases.
    pub iterations: Vec<(String, u64)>,
    /// The solvers that took part and what each found.
    pub contenders: Vec<Contender>,
    /// How the policy fared.
    pub policy: PolicyUse,
    /// What ended one of the paper's algorithms before it was finished.
    pub unfinished: Option<Unfinished>,
}

/// How the policy fared in a solve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PolicyUse {
    /// The solver asked for uses none.
    Unused,
    /// The solver would have used one, but none was passed.
    Missing,
    /// It built a feasible tour.
    Built,
    /// It found no feasible tour.
    NoTour,
    /// It broke down.
    Failed(QError),
}

/// A solver that took part.
#[derive(Clone, Debug, PartialEq)]
pub struct Contender {
    /// Its name.
    pub solver: String,
    /// Value of its tour.
    pub objective: f64,
    /// What is known of its tour.
    pub status: Status,
    /// Iterations that it did.
    pub iterations: u64,
}

/// The solver is not for this problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the solver \"{solver}\" is not for this problem: it needs {needs}")]
pub struct Unavailable {
    /// The solver asked for.
    pub solver: SolverName,
    /// What its problem has and this one has not.
    pub needs: &'static str,
}

/// An order of candidates, with the name of the solver that found it.
pub(super) struct Found {
    pub order: Vec<u32>,
    pub solver: SolverName,
    pub iterations: Vec<(String, u64)>,
    pub claim: Claim,
}

/// What a solver has proven, about every tour that the check accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Claim {
    /// Nothing.
    None,
    /// No feasible tour has a better objective than this; it may be infinite.
    Bound(f64),
    /// No feasible tour exists.
    Infeasible,
}

/// Solves a scenario. Same scenario, solver, seed and number of iterations: same plan.
///
/// # Errors
/// The solver is not for this problem.
pub fn solve(scenario: &Scenario, options: &Options<'_>) -> Result<Outcome, Unavailable> {
    solve_compiled(&Instance::new(scenario), options)
}

/// [`solve`] of a scenario that is compiled already, so that the two can be timed apart.
///
/// # Errors
/// The solver is not for this problem.
pub fn solve_compiled(
    instance: &Instance<'_>,
    options: &Options<'_>,
) -> Result<Outcome, Unavailable> {
    solve_with(instance, options, &PaperOptions::default())
}

/// [`solve_compiled`] with other options for the paper's algorithms.
///
/// # Errors
/// The solver is not for this problem.
pub fn solve_with(
    instance: &Instance<'_>,
    options: &Options<'_>,
    paper: &PaperOptions,
) -> Result<Outcome, Unavailable> {
    let mut budget = Budget::new(options.stop);
    let mut rng = Pcg64Mcg::seed_from_u64(options.seed);
    let single = |order, phase: &str, budget: &Budget<'_>| Found {
        order,
        solver: options.solver,
        iterations: vec![(phase.to_owned(), budget.iterations())],
        claim: Claim::None,
    };
    let mut policy = PolicyUse::Unused;
    let mut unfinished = None;
    let found = match options.solver {
        SolverName::Auto => {
            let (found, fared) = auto::auto(instance, options.policy, &mut rng, &mut budget);
            policy = fared;
            found
        }
        SolverName::Dqn => {
            let effort = Effort::whole(Problem::of(instance.scenario.objective));
            let (found, fared) = dqn::dqn(instance, options.policy, effort, &mut rng, &mut budget);
            policy = fared;
            // The policy makes a plan better, never possible: what it left undone is the baseline's.
            vec![found.unwrap_or_else(|| baseline::finish(instance, &mut rng, &mut budget))]
        }
        SolverName::Baseline => vec![baseline::solve(instance, &[], &mut rng, &mut budget)],
        SolverName::Greedy => {
            vec![single(greedy::greedy(instance, &mut budget), "insertion", &budget)]
        }
        SolverName::Nearest => {
            vec![single(greedy::nearest(instance, paper.literal, &mut budget), "walk", &budget)]
        }
        SolverName::Random => {
            vec![single(random::random(instance, paper, &mut rng, &mut budget), "walks", &budget)]
        }
        SolverName::Exact => {
            vec![exact::solve(instance, &[], exact::Effort::Whole, &mut rng, &mut budget)]
        }
        SolverName::Acs | SolverName::Dp | SolverName::Mst | SolverName::Cmst | SolverName::App => {
            let (attempt, phase) =
                paper::solve(instance, options.solver, paper, &mut rng, &mut budget)?;
            unfinished = attempt.unfinished;
            vec![single(attempt.order, phase, &budget)]
        }
    };
    Ok(Outcome { policy, unfinished, ..outcome(instance, &found) })
}

/// The plan of the best tour found, the earlier among equals; each solver is a contender. What one has
/// proven holds for the tours of all.
fn outcome(instance: &Instance<'_>, all: &[Found]) -> Outcome {
    let value = |found: &Found| Value::of(instance, &Tour::new(instance, &found.order));
    let best = all.iter().min_by(|a, b| value(a).compare(&value(b)));
    let plan = |found: &Found| {
        let mut plan = plan_of(instance, &found.order, found.solver.name());
        for other in all {
            claimed(instance, &mut plan, other.claim);
        }
        plan
    };
    let contender = |found: &Found| {
        let plan = plan(found);
        Contender {
            solver: plan.solver,
            objective: plan.objective,
            status: plan.status,
            iterations: found.iterations.iter().map(|(_, iterations)| iterations).sum(),
        }
    };
    Outcome {
        plan: best.map_or_else(|| plan_of(instance, &[], SolverName::Auto.name()), plan),
        iterations: all.iter().flat_map(|found| found.iterations.clone()).collect(),
        contenders: all.iter().map(contender).collect(),
        policy: PolicyUse::Unused,
        unfinished: None,
    }
}

/// Whether a solver has proven its tour to be the best.
pub(super) fn is_optimal(instance: &Instance<'_>, found: &Found) -> bool {
    let mut plan = plan_of(instance, &found.order, found.solver.name());
    claimed(instance, &mut plan, found.claim);
    plan.status == Status::Optimal
}

/// Adds to a plan what is proven.
fn claimed(instance: &Instance<'_>, plan: &mut Plan, claim: Claim) {
    match claim {
        Claim::Infeasible if plan.status == Status::BestEffort => plan.status = Status::Infeasible,
        Claim::Bound(bound) if bound.is_finite() => {
            // Rounding may leave a bound on the wrong side of the objective that it proves.
            let minimised = instance.scenario.objective == Objective::MinDistance;
            let missed = if minimised { plan.objective - bound } else { bound - plan.objective };
            let proven = plan.status.is_feasible() && missed <= tolerance(plan.objective);
            if proven {
                plan.status = Status::Optimal;
            }
            plan.bound = Some(if proven { plan.objective } else { bound });
        }
        _ => {}
    }
}

/// The plan of the empty tour, under the name of a solver.
pub fn empty_plan(scenario: &Scenario) -> Plan {
    plan_from_order(scenario, &[], SolverName::Greedy.name())
}

/// The plan of a tour given as request indices in order. Indices of requests that are no candidates
/// (already charged, or beyond the list) and repetitions are left out. A tour that breaks a constraint
/// gives a plan whose status is `best_effort`; whether 1 to 3 hold is for the caller to see to.
pub fn plan_from_order(scenario: &Scenario, order: &[usize], solver: &str) -> Plan {
    let instance = Instance::new(scenario);
    let mut candidate_of = vec![None; scenario.requests.len()];
    for (i, candidate) in (0u32..).zip(&instance.candidates) {
        candidate_of[candidate.request] = Some(i);
    }
    let stops = order.iter().filter_map(|&request| candidate_of.get_mut(request)?.take());
    let stops: Vec<u32> = stops.collect();
    plan_of(&instance, &stops, solver)
}
