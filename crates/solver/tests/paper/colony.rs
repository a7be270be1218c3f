//! `acs`, and the walks that it is compared with.

use voltour_solver::generate::{KCoverage, k_coverage};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{AcsOptions, PaperOptions, SolverName, Unfinished};

use crate::run::{attempt, optimum, parsed, plan, trials};

fn small(seed: u64) -> Scenario {
    let options = KCoverage { sensors: 32, k: 2, alpha: 0.3, ..KCoverage::default() };
    parsed(&k_coverage(&options, seed).unwrap())
}

fn colony(acs: AcsOptions) -> PaperOptions {
    PaperOptions { acs, ..PaperOptions::default() }
}

#[test]
fn it_finds_most_optima_of_small_scenarios_and_beats_none() {
    let (mut all, mut found) = (0, 0);
    for seed in 0..trials(25) {
        let scenario = small(seed);
        let Some(best) = optimum(&scenario) else { continue };
        let plan = plan(&scenario, SolverName::Acs, &PaperOptions::default());
        all += 1;
        assert!(!plan.status.is_feasible() || plan.objective >= best.objective - 1e-4);
        found += u64::from(plan.status.is_feasible() && plan.objective <= best.objective + 1e-4);
    }
    assert!(2 * found > all, "{found} of {all}");
}

#[test]
fn pheromone_is_what_ants_learn_from() {
    // Alone, ants that take only random steps do not find what a colony finds, unless there are very many of them.
    let ants = |decay, local_decay| {
        let first =
            AcsOptions { runs: 1, iterations: 100, q0: 0.0, beta: 0.0, ..Default::default() };
        let acs = AcsOptions { decay, local_decay, ..first };
        let lengths = (0..trials(30)).filter_map(|seed| {
            let scenario = small(seed);
            optimum(&scenario)?;
            let plan = plan(&scenario, SolverName::Acs, &colony(acs.clone()));
            plan.status.is_feasible().then_some(plan.objective)
        });
        let lengths: Vec<f64> = lengths.collect();
        (lengths.len(), lengths.iter().sum::<f64>())
    };
    let (learning, alone) = (ants(0.1, 0.1), ants(0.0, 0.0));
    assert!(learning.0 >= alone.0, "{learning:?} {alone:?}");
    assert!(learning.0 > alone.0 || learning.1 < alone.1, "{learning:?} {alone:?}");
}

#[test]
fn its_stop_rules_end_it() {
    let scenario = small(1);
    let iterations = |acs| {
        let outcome = attempt(&scenario, SolverName::Acs, &colony(acs), u64::MAX).unwrap();
        assert_eq!(outcome.unfinished, None);
        outcome.iterations[0].1
    };
    let few = AcsOptions { runs: 2, iterations: 3, ants: 5, ..Default::default() };
    assert_eq!(iterations(few), 2 * 3 * 5);
    let impatient = AcsOptions { runs: 1, iterations: 100_000, patience: 4, ..Default::default() };
    assert!(iterations(impatient) < 10_000);
    let cut = attempt(&scenario, SolverName::Acs, &PaperOptions::default(), 40).unwrap();
    assert_eq!((cut.unfinished, cut.iterations[0].1), (Some(Unfinished::Budget), 40));
    assert!(!cut.plan.stops.is_empty());
}

#[test]
fn literal_walks_go_also_where_nobody_needs_them() {
    let literal = PaperOptions { literal: true, ..PaperOptions::default() };
    for solver in [SolverName::Nearest, SolverName::Random] {
        let stops = |options: &PaperOptions| {
            let plans = (0..trials(15)).map(|seed| plan(&small(seed), solver, options));
            plans.map(|plan| plan.stops.len()).sum::<usize>()
        };
        assert!(stops(&literal) > stops(&PaperOptions::default()), "{solver}");
    }
}
