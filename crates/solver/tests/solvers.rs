//! The solvers against an oracle, the checker, and each other.
#![allow(clippy::unwrap_used, clippy::panic)]

mod mixed;

use voltour_solver::check::check;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Objective, Scenario};
use voltour_solver::solvers::{Options, Outcome, SolverName, empty_plan, plan_from_order, solve};
use voltour_solver::stop::MaxIterations;

fn run(scenario: &Scenario, solver: SolverName, seed: u64, iterations: u64) -> Outcome {
    solve(scenario, &Options { solver, seed, stop: &MaxIterations(iterations), policy: None })
        .unwrap()
}

fn order(scenario: &Scenario, plan: &Plan) -> Vec<usize> {
    let request = |id: &String| {
        let asks = |r: &voltour_solver::scenario::Request| &scenario.sensors[r.sensor].id == id;
        scenario.requests.iter().position(asks).unwrap()
    };
    plan.stops.iter().map(|stop| request(&stop.sensor)).collect()
}

fn assert_holds(scenario: &Scenario, plan: &Plan) {
    let broken = check(scenario, plan);
    assert!(broken.is_empty(), "{:?} {}: {broken:?}", scenario.name, plan.solver);
}

/// Compares a plan with the oracle: 0 if it is as good, 1 if not.
fn misses(scenario: &Scenario, plan: &Plan) -> usize {
    assert_holds(scenario, plan);
    let found = mixed::worth(scenario, &order(scenario, plan));
    match (mixed::oracle(scenario), found) {
        (None, None) => 0,
        (Some(best), Some(found)) => {
            assert!(!mixed::better(&found, &best), "{:?}: {found:?} {best:?}", scenario.name);
            usize::from(mixed::better(&best, &found))
        }
        (Some(_), None) => 1,
        (None, Some(found)) => panic!("{:?}: the oracle has none, {found:?}", scenario.name),
    }
}

#[test]
fn the_best_tour_of_tiny_scenarios_is_found() {
    for seed in 0..2000 {
        let document = mixed::draw(1 + seed as usize % 5, seed);
        let Ok(scenario) = Scenario::from_document(&document) else { continue };
        let outcome = run(&scenario, SolverName::Auto, seed, 1_000_000);
        assert_eq!(misses(&scenario, &outcome.plan), 0, "{:?}", scenario.name);
    }
}

#[test]
fn every_solver_gives_plans_that_hold() {
    let solvers = [
        SolverName::Auto,
        SolverName::Baseline,
        SolverName::Greedy,
        SolverName::Nearest,
        SolverName::Random,
    ];
    for seed in 0..150 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(9 + seed as usize % 12, seed))
        else {
            continue;
        };
        for solver in solvers {
            assert_holds(&scenario, &run(&scenario, solver, seed, 300).plan);
        }
        assert_holds(&scenario, &plan_from_order(&scenario, &[], "auto"));
        assert_eq!(empty_plan(&scenario).stops.len(), 0);
    }
}

#[test]
fn the_same_seed_and_iterations_give_the_same_plan() {
    for seed in 0..60 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(14, seed)) else { continue };
        let plan = || run(&scenario, SolverName::Auto, 5, 700).plan;
        assert_eq!(plan(), plan());
    }
}

#[test]
fn a_run_cut_short_by_its_host_is_a_run_of_as_many_iterations() {
    for seed in 0..40 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(12, seed)) else { continue };
        // A host's clock, as far as a solver can tell.
        let cut = |iterations: u64| iterations >= 137 + 31 * seed;
        let options = Options { solver: SolverName::Auto, seed: 1, stop: &cut, policy: None };
        let by_host = solve(&scenario, &options).unwrap();
        let by_count = run(&scenario, SolverName::Auto, 1, 137 + 31 * seed);
        assert_eq!(by_host.plan, by_count.plan);
    }
}

#[test]
fn more_iterations_are_never_worse() {
    for seed in 0..40 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(12, seed)) else { continue };
        let worth = |iterations| {
            let plan = run(&scenario, SolverName::Auto, 3, iterations).plan;
            mixed::worth(&scenario, &order(&scenario, &plan))
        };
        if let (Some(few), Some(many)) = (worth(50), worth(2000)) {
            assert!(!mixed::better(&few, &many), "{:?}: {few:?} {many:?}", scenario.name);
        }
    }
}

#[test]
fn the_order_of_the_document_does_not_change_the_value() {
    for seed in 0..300 {
        let mut document = mixed::draw(5, seed);
        let Ok(scenario) = Scenario::from_document(&document) else { continue };
        let first = run(&scenario, SolverName::Auto, 0, 1_000_000).plan;
        document.requests.reverse();
        document.sensors.reverse();
        if let Some(travel) = &mut document.travel {
            travel.distance_m[2..].reverse();
            for row in &mut travel.distance_m {
                row[2..].reverse();
            }
        }
        let turned = Scenario::from_document(&document).unwrap();
        let second = run(&turned, SolverName::Auto, 0, 1_000_000).plan;
        assert!((first.objective - second.objective).abs() < 1e-6, "{:?}", scenario.name);
    }
}

#[test]
fn solvers_that_are_not_for_a_problem_say_so() {
    let mut document = mixed::draw(3, 1);
    document.objective = Objective::MaxReward;
    let scenario = Scenario::from_document(&document).unwrap();
    let options =
        Options { solver: SolverName::Acs, seed: 0, stop: &MaxIterations(1), policy: None };
    assert_eq!(solve(&scenario, &options).unwrap_err().solver, SolverName::Acs);
    assert_eq!("cmst".parse::<SolverName>().unwrap().to_string(), "cmst");
    assert!("best".parse::<SolverName>().is_err());
}
