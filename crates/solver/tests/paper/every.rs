//! What holds of every one of them, on scenarios that mix all features of the format.

use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{PaperOptions, SolverName, Unfinished};

use crate::mixed;
use crate::run::{AMPLE, attempt, order, trials};

const SOLVERS: [SolverName; 7] = [
    SolverName::Acs,
    SolverName::Dp,
    SolverName::Mst,
    SolverName::Cmst,
    SolverName::App,
    SolverName::Nearest,
    SolverName::Random,
];

fn options() -> PaperOptions {
    PaperOptions { app_step_s: 4.0, ..PaperOptions::default() }
}

#[test]
fn none_beats_the_best_of_all_tours() {
    let mut solved = [0; SOLVERS.len()];
    for seed in 0..trials(700) {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(1 + seed as usize % 5, seed))
        else {
            continue;
        };
        let best = mixed::oracle(&scenario);
        for (solver, solved) in SOLVERS.into_iter().zip(&mut solved) {
            let Ok(outcome) = attempt(&scenario, solver, &options(), 20_000) else { continue };
            *solved += 1;
            let found = mixed::worth(&scenario, &order(&scenario, &outcome.plan));
            if let (Some(best), Some(found)) = (&best, &found) {
                let name = &scenario.name;
                assert!(!mixed::better(found, best), "{name:?} {solver}: {found:?} {best:?}");
            }
        }
    }
    assert!(solved.iter().all(|&solved| solved > 15), "{solved:?}");
}

#[test]
fn the_same_seed_gives_the_same_plan_and_limits_end_each() {
    let small = PaperOptions { memory_bytes: 16, ..options() };
    let mut short_of_memory = 0;
    for seed in 0..trials(120) {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(9, seed)) else { continue };
        for solver in SOLVERS {
            for iterations in [0, 1, 5, 60] {
                let plan = || attempt(&scenario, solver, &options(), iterations).map(|o| o.plan);
                assert_eq!(plan(), plan());
            }
            let Ok(outcome) = attempt(&scenario, solver, &small, AMPLE) else { continue };
            if outcome.unfinished == Some(Unfinished::Memory) {
                short_of_memory += 1;
                assert!(outcome.plan.stops.is_empty(), "{solver}");
            }
        }
    }
    assert!(short_of_memory > 20, "{short_of_memory}");
}

#[test]
fn whoever_is_not_for_a_problem_says_what_it_needs() {
    let scenario = Scenario::from_document(&mixed::draw(3, 2)).unwrap();
    let refused: Vec<String> = SOLVERS
        .iter()
        .filter_map(|&solver| attempt(&scenario, solver, &options(), 10).err())
        .map(|error| error.to_string())
        .collect();
    assert!(refused.len() >= 3, "{refused:?}");
    assert!(refused.iter().all(|text| text.contains("is not for this problem: it needs")));
}
