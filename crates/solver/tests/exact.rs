//! The exact solver against an oracle that tries every tour.
#![allow(clippy::unwrap_used, clippy::panic)]

mod mixed;

use mixed::{better, draw, oracle};
use voltour_solver::check::check;
use voltour_solver::plan::Status;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, SolverName, solve};
use voltour_solver::stop::MaxIterations;

#[test]
fn agrees_with_every_tour() {
    let (mut optimal, mut infeasible, mut open) = (0, 0, 0);
    let count = std::env::var("VOLTOUR_TRIALS").map_or(1_000, |n| n.parse().unwrap());
    for seed in 0..count {
        let n = 1 + seed as usize % 6;
        let scenario = Scenario::from_document(&draw(n, seed)).unwrap();
        let options =
            Options { solver: SolverName::Exact, seed: 0, stop: &MaxIterations(1_000_000) };
        let plan = solve(&scenario, &options).unwrap().plan;
        let broken = check(&scenario, &plan);
        assert!(broken.is_empty(), "{seed}: {broken:?}");
        let best = oracle(&scenario);
        let feasible = best.filter(|best| best.0 == 0 && best.1 == 0);
        match plan.status {
            Status::Optimal => {
                optimal += 1;
                let best = feasible.unwrap_or_else(|| panic!("{seed}: no feasible tour"));
                let minimised = scenario.objective.name() == "min_distance";
                let cost = if minimised { plan.objective } else { -plan.objective };
                let mine = (0, 0, cost, best.3);
                assert!(!better(&best, &mine), "{seed}: {best:?} beats {mine:?}");
            }
            Status::Infeasible => {
                infeasible += 1;
                assert!(feasible.is_none(), "{seed}: {best:?}");
            }
            _ => {
                open += 1;
                println!("{seed}: open {:?} {:?} {:?}", plan.status, plan.bound, best);
            }
        }
    }
    println!("optimal {optimal} infeasible {infeasible} open {open}");
    assert!(open * 100 < count, "{open} open");
}
