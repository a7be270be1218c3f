//! Conflicts are infeasible, irreducible, and made of what the scenario really asks.

use voltour_solver::explain::{Clause, Explanation, explain};
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::{Document, Place, Point, Scenario};
use voltour_solver::solvers::{Options, SolverName, solve};
use voltour_solver::stop::MaxIterations;

use crate::{mixed, oracle};

pub fn plan(scenario: &Scenario, iterations: u64) -> Plan {
    let stop = MaxIterations(iterations);
    solve(scenario, &Options { solver: SolverName::Auto, seed: 0, stop: &stop, policy: None })
        .unwrap()
        .plan
}

/// Draws scenarios until so many have no feasible tour, and gives each to a test.
pub fn infeasible(wanted: usize, most: usize, mut test: impl FnMut(&Document, &Scenario, &Plan)) {
    let mut found = 0;
    for seed in 0.. {
        let document = mixed::draw(1 + seed as usize % most, seed);
        let Ok(scenario) = Scenario::from_document(&document) else { continue };
        let plan = plan(&scenario, if most < 6 { 100_000 } else { 500 });
        if !plan.status.is_feasible() {
            test(&document, &scenario, &plan);
            found += 1;
            if found == wanted {
                return;
            }
        }
    }
}

fn without(clauses: &[Clause], left_out: usize) -> Vec<Clause> {
    let kept = clauses.iter().enumerate().filter(|(i, _)| *i != left_out);
    kept.map(|(_, clause)| clause.clone()).collect()
}

#[test]
fn conflicts_of_tiny_scenarios_are_infeasible_and_irreducible() {
    let (mut told, mut edges) = (0, 0);
    infeasible(600, 5, |_, scenario, plan| {
        let explanation = explain(scenario, plan, 0, &MaxIterations(10_000_000));
        let name = &scenario.name;
        assert!(explanation.complete, "{name:?}");
        assert_eq!(explanation.status, Status::Infeasible, "{name:?}");
        let conflict = explanation.conflict.unwrap();
        assert!(conflict.irreducible, "{name:?}");
        let clauses = &conflict.clauses;
        told += 1;
        edges += usize::from(oracle::possible(scenario, clauses).is_none());
        assert_ne!(oracle::possible(scenario, clauses), Some(true), "{name:?}: {clauses:?}");
        for i in 0..clauses.len() {
            let fewer = without(clauses, i);
            assert_ne!(oracle::possible(scenario, &fewer), Some(false), "{name:?}: {fewer:?}");
        }
        for clause in clauses {
            assert!(is_of(scenario, clause), "{name:?}: {clause:?}");
        }
        assert!(conflict.sentence.ends_with('.'), "{}", conflict.sentence);
    });
    assert!(told == 600 && edges < 20, "{edges}");
}

/// Whether the scenario says what the clause says.
fn is_of(scenario: &Scenario, clause: &Clause) -> bool {
    let request = |id: &String| {
        scenario.requests.iter().find(|r| scenario.sensors[r.sensor].id == *id).unwrap()
    };
    match clause {
        Clause::Required { sensor } => request(sensor).required,
        Clause::Deadline { sensor, deadline_s } => request(sensor).deadline_s == Some(*deadline_s),
        Clause::Timespan { timespan_s } => scenario.charger.timespan_s == Some(*timespan_s),
        Clause::Capacity { capacity_j } => scenario.charger.capacity_j == Some(*capacity_j),
        Clause::Demand { at_m, needs, members } => {
            let at = Point::from(*at_m);
            let covers =
                |place: &Place, range: Option<f64>| (place.at(0.0) - at).norm() <= range.unwrap();
            let covering: Vec<usize> = (0..scenario.sensors.len())
                .filter(|&s| covers(&scenario.sensors[s].place, scenario.sensors[s].range_m))
                .collect();
            let asks = |s: &&usize| {
                scenario.requests.iter().any(|r| r.sensor == **s && !scenario.already_charged(r))
            };
            let candidates: Vec<&usize> = covering.iter().filter(asks).collect();
            let k = scenario.coverage.as_ref().unwrap().k as usize;
            let others = covering.len() - candidates.len();
            let ids: Vec<String> =
                candidates.iter().map(|&&s| scenario.sensors[s].id.clone()).collect();
            k.min(covering.len()) == others + *needs as usize && ids == *members
        }
    }
}

#[test]
fn a_conflict_cut_short_is_still_a_conflict() {
    infeasible(150, 5, |_, scenario, plan| {
        for iterations in [0, 1, 3, 10, 30, 100, 300] {
            let explanation: Explanation = explain(scenario, plan, 0, &MaxIterations(iterations));
            assert!(explanation.iterations <= iterations + 1);
            let Some(conflict) = explanation.conflict else {
                assert!(!explanation.complete && !explanation.status.is_feasible());
                continue;
            };
            let possible = oracle::possible(scenario, &conflict.clauses);
            assert_ne!(possible, Some(true), "{:?}", scenario.name);
            assert!(conflict.irreducible || !explanation.complete);
        }
    });
}

#[test]
fn conflicts_of_larger_scenarios_are_found_where_they_are_local() {
    let mut told = 0;
    infeasible(40, 25, |_, scenario, plan| {
        let explanation = explain(scenario, plan, 0, &MaxIterations(100_000));
        let Some(conflict) = explanation.conflict else { return };
        told += 1;
        if scenario.requests.len() <= 6 {
            assert_ne!(oracle::possible(scenario, &conflict.clauses), Some(true));
        }
    });
    assert!(told > 20, "{told}");
}
