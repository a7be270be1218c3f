//! What holds of a run however early it ends: its claims are true, its tour never gets worse with more
//! time, and what it has once proven stays proven.

use voltour_solver::check::check;
use voltour_solver::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::tolerance::tolerance;

use crate::draw::awkward;
use crate::run::{AMPLE, broken_off, exact, trials};
use crate::truth::{Truth, cost_of, needs};

const BUDGETS: [u64; 13] = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1_000, 3_000, 10_000];

/// By so many iterations the first tour of these scenarios is constructed. A construction that is cut
/// short may, by luck, come to a better tour than a whole one.
const CONSTRUCTED: usize = 6;

/// Whether a plan's claim ends the matter.
fn decided(plan: &Plan) -> bool {
    matches!(plan.status, Status::Optimal | Status::Infeasible)
}

/// Fails where two plans of one scenario contradict each other, `late` having had more time.
fn assert_follows(scenario: &Scenario, early: &Plan, late: &Plan) {
    let name = &scenario.name;
    assert!(
        !early.status.is_feasible() || late.status.is_feasible(),
        "{name:?}: {early:?} {late:?}"
    );
    assert!(!decided(early) || early.status == late.status, "{name:?}: {early:?} {late:?}");
    if early.status.is_feasible() {
        let (before, after) =
            (cost_of(scenario, early.objective), cost_of(scenario, late.objective));
        assert!(after <= before + 1e-9 * (1.0 + before.abs()), "{name:?}: {early:?} {late:?}");
    }
    if let (true, Some(bound)) = (late.status.is_feasible(), early.bound) {
        let least = cost_of(scenario, bound) - 1.001 * tolerance(bound);
        assert!(cost_of(scenario, late.objective) >= least, "{name:?}: {early:?} {late:?}");
    }
}

#[test]
fn claims_are_true_whenever_the_budget_ends() {
    for seed in 0..trials(250) {
        let document = awkward(2 + (seed % 5) as usize, 2_000_000 + seed);
        let scenario = Scenario::from_document(&document).unwrap();
        let truth = Truth::of(&scenario, &needs(&scenario));
        let plans = BUDGETS.map(|iterations| exact(&scenario, 0, iterations));
        for plan in &plans {
            truth.assert_bears_out(&scenario, plan);
        }
        for pair in plans[CONSTRUCTED..].windows(2) {
            assert_follows(&scenario, &pair[0], &pair[1]);
        }
    }
}

#[test]
fn other_seeds_come_to_the_same_end() {
    for seed in 0..trials(150) {
        let document = awkward(2 + (seed % 5) as usize, 3_000_000 + seed);
        let scenario = Scenario::from_document(&document).unwrap();
        let first = exact(&scenario, 0, AMPLE);
        assert_eq!(first, exact(&scenario, 0, AMPLE), "{:?}: not repeatable", scenario.name);
        for other in 1..4 {
            let second = exact(&scenario, other, AMPLE);
            assert_eq!(first.status, second.status, "{:?}", scenario.name);
            let differ = (first.objective - second.objective).abs();
            let same = differ <= 1.001 * tolerance(first.objective);
            assert!(same || !decided(&first) || !first.status.is_feasible(), "{:?}", scenario.name);
        }
    }
}

/// Scenarios of the presets, of a size that the solver proves but no enumeration does.
fn presets() -> Vec<Scenario> {
    let settings = KCoverage { sensors: 32, k: 2, alpha: 0.6, ..KCoverage::default() };
    let coverage = (0..6).map(|seed| k_coverage(&settings, seed).unwrap());
    let settings = Reward { sensors: 14, alpha: 1.0, capacity_j: 200e3, ..Reward::default() };
    let rewards = (0..6).map(|seed| reward(&settings, seed).unwrap());
    let settings = Mobile { sensors: 12, ..Mobile::default() };
    let mobiles = (0..6).map(|seed| mobile(&settings, seed).unwrap());
    let documents = coverage.chain(rewards).chain(mobiles);
    documents.map(|document| Scenario::from_document(&document).unwrap()).collect()
}

#[test]
fn presets_get_better_and_stay_proven() {
    for scenario in presets() {
        let mut plans = BUDGETS.map(|iterations| exact(&scenario, 1, iterations)).to_vec();
        plans.push(exact(&scenario, 1, 60_000));
        for plan in &plans {
            assert_eq!(check(&scenario, plan), [], "{:?}", scenario.name);
        }
        let plans = &plans[CONSTRUCTED..];
        for (i, early) in plans.iter().enumerate() {
            plans[i..].iter().for_each(|late| assert_follows(&scenario, early, late));
        }
        let last = plans.last().unwrap();
        println!("{:?}: {:?} {:?} {:?}", scenario.name, last.status, last.objective, last.bound);
        assert_eq!(exact(&scenario, 1, 500), exact(&scenario, 1, 500));
        for seed in 2..4 {
            let other = exact(&scenario, seed, 60_000);
            if decided(last) && decided(&other) {
                assert_follows(&scenario, last, &other);
                assert_follows(&scenario, &other, last);
            }
        }
    }
}

#[test]
fn claims_are_true_where_a_step_is_broken_off() {
    const MOMENTS: u64 = 40;
    for scenario in presets() {
        let (last, asked) = broken_off(&scenario, u64::MAX);
        assert!(decided(&last), "{:?}", scenario.name);
        for moment in 0..MOMENTS {
            let (early, _) = broken_off(&scenario, asked * moment / MOMENTS);
            assert_eq!(check(&scenario, &early), [], "{:?}", scenario.name);
            assert_follows(&scenario, &early, &last);
        }
    }
}
