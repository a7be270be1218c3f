//! Solving with a policy: what it may do to a plan, and that no way in which it fails costs the plan.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicUsize, Ordering};

use voltour_solver::check::check;
use voltour_solver::generate::{self, KCoverage, Mobile, Reward};
use voltour_solver::policy::guided::Rule;
use voltour_solver::policy::{Batch, Problem, QError, QFunction};
use voltour_solver::scenario::{Document, Scenario};
use voltour_solver::solvers::{Options, Outcome, PolicyUse, SolverName, solve};
use voltour_solver::stop::MaxIterations;

/// A Q-function that gives the values of the rule, but breaks after some calls.
struct Breaks {
    problem: Problem,
    after: usize,
    calls: AtomicUsize,
    how: fn(Vec<f32>) -> Result<Vec<f32>, QError>,
}

impl QFunction for Breaks {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        let q = Rule(self.problem).values(batch)?;
        if self.calls.fetch_add(1, Ordering::Relaxed) < self.after { Ok(q) } else { (self.how)(q) }
    }
}

fn drawn(seed: u64) -> Vec<Scenario> {
    let k_coverage = KCoverage { sensors: 40, k: 2, ..KCoverage::default() };
    let reward = Reward { sensors: 40, alpha: 1.0, ..Reward::default() };
    let mobile = Mobile { sensors: 12, ..Mobile::default() };
    let documents: [Document; 3] = [
        generate::k_coverage(&k_coverage, seed).unwrap(),
        generate::reward(&reward, seed).unwrap(),
        generate::mobile(&mobile, seed).unwrap(),
    ];
    documents.iter().map(|document| Scenario::from_document(document).unwrap()).collect()
}

fn solved(
    scenario: &Scenario,
    solver: SolverName,
    iterations: u64,
    policy: Option<&dyn QFunction>,
) -> Outcome {
    let options = Options { solver, seed: 3, stop: &MaxIterations(iterations), policy };
    let outcome = solve(scenario, &options).unwrap();
    assert_eq!(check(scenario, &outcome.plan), []);
    outcome
}

#[test]
fn a_policy_builds_the_plan_of_dqn_and_takes_part_in_auto() {
    for seed in 0..5 {
        for scenario in drawn(seed) {
            let rule = Rule(Problem::of(scenario.objective));
            let dqn = solved(&scenario, SolverName::Dqn, 1_000, Some(&rule));
            if dqn.policy == PolicyUse::Built {
                assert_eq!(dqn.plan.solver, "dqn");
                assert!(dqn.plan.status.is_feasible());
                assert!(dqn.contenders[0].iterations <= 32, "complete roll-outs");
            }
            let auto = solved(&scenario, SolverName::Auto, 200, Some(&rule));
            let built = auto.contenders.iter().any(|contender| contender.solver == "dqn");
            assert_eq!(built, auto.policy == PolicyUse::Built);
        }
    }
}

#[test]
fn same_seed_and_iterations_give_the_same_plan() {
    for scenario in drawn(7) {
        let rule = Rule(Problem::of(scenario.objective));
        for solver in [SolverName::Dqn, SolverName::Auto] {
            let plan = || solved(&scenario, solver, 60, Some(&rule)).plan;
            assert_eq!(plan(), plan(), "{solver}");
        }
    }
}

#[test]
fn without_a_policy_dqn_plans_by_the_baseline() {
    for scenario in drawn(1) {
        let outcome = solved(&scenario, SolverName::Dqn, 500, None);
        assert_eq!(outcome.policy, PolicyUse::Missing);
        assert_eq!(outcome.plan.solver, "baseline");
        assert!(outcome.plan.status.is_feasible());
    }
}

#[test]
fn a_policy_that_takes_all_the_time_leaves_a_whole_construction() {
    struct Slow;
    impl QFunction for Slow {
        fn values(&self, _: &Batch) -> Result<Vec<f32>, QError> {
            Err(QError::TooSlow)
        }
    }
    let small = KCoverage { sensors: 32, k: 2, alpha: 0.15, ..KCoverage::default() };
    let small = Scenario::from_document(&generate::k_coverage(&small, 5).unwrap()).unwrap();
    assert!((3..=8).contains(&small.requests.len()), "{}", small.requests.len());
    for scenario in drawn(4).iter().chain([&small]) {
        let outcome = solved(scenario, SolverName::Dqn, 0, Some(&Slow));
        assert_eq!(outcome.policy, PolicyUse::Failed(QError::TooSlow));
        assert_eq!(outcome.plan.solver, "baseline");
        let built = solved(scenario, SolverName::Greedy, 1_000, None);
        assert!(outcome.plan.status.is_feasible() && !built.plan.stops.is_empty());
        assert!(outcome.plan.stops.len() >= built.plan.stops.len(), "{:?}", outcome.plan);
    }
    let best = solved(&small, SolverName::Exact, u64::MAX, None).plan.objective;
    let whole = solved(&small, SolverName::Dqn, 0, Some(&Slow)).plan.objective;
    assert!((whole - best).abs() < 1e-9, "{whole}, {best}");
}

#[test]
fn a_policy_that_breaks_costs_nothing_but_itself() {
    type How = fn(Vec<f32>) -> Result<Vec<f32>, QError>;
    let nan: How = |q| Ok(vec![f32::NAN; q.len()]);
    let infinite: How = |q| Ok(vec![f32::INFINITY; q.len()]);
    let short: How = |q| Ok(q[1..].to_vec());
    let fails: How = |_| Err(QError::Failed("out of order".to_owned()));
    let slow: How = |_| Err(QError::TooSlow);
    for scenario in drawn(2) {
        let problem = Problem::of(scenario.objective);
        for how in [nan, infinite, short, fails, slow] {
            for (after, solver) in [0, 1, 5, 40]
                .into_iter()
                .flat_map(|n| [(n, SolverName::Dqn), (n, SolverName::Auto)])
            {
                let policy = Breaks { problem, after, calls: AtomicUsize::new(0), how };
                let outcome = solved(&scenario, solver, 300, Some(&policy));
                assert!(outcome.plan.status.is_feasible(), "{solver} after {after}");
                if matches!(outcome.policy, PolicyUse::Failed(_)) {
                    let without = solved(&scenario, solver, 300, None);
                    assert_eq!(outcome.plan, without.plan, "{solver} after {after}: as without it");
                    assert_eq!(outcome.iterations, without.iterations, "{solver} after {after}");
                }
                assert!(!outcome.plan.stops.is_empty(), "{solver} after {after}: not given up");
                let calls = policy.calls.load(Ordering::Relaxed);
                let failed = matches!(outcome.policy, PolicyUse::Failed(_));
                assert_eq!(failed, calls > after, "{:?} after {after}", outcome.policy);
            }
        }
    }
}

#[test]
fn what_a_policy_cannot_build_the_baseline_can() {
    // Values that lead astray: the most expensive insertion first, what is needed last.
    struct Worst;
    impl QFunction for Worst {
        fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
            Ok(Rule(Problem::KCoverage).values(batch)?.iter().map(|q| -100.0 * q).collect())
        }
    }
    let mut failed = 0;
    for seed in 0..40 {
        let options = KCoverage { sensors: 32, k: 2, alpha: 0.8, ..KCoverage::default() };
        let document = generate::k_coverage(&options, seed).unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        let outcome = solved(&scenario, SolverName::Dqn, 2_000, Some(&Worst));
        if outcome.policy == PolicyUse::NoTour {
            failed += 1;
            assert_eq!(outcome.plan.solver, "baseline");
        }
    }
    assert!(failed > 0, "some scenarios must be out of reach of the worst policy");
}
