//! The search before the first bound: long where the proof will be, and the baseline's own.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::effort::{Effort, First, long_search};
use super::solve::{is_feasible, solve};
use crate::generate::Cell;
use crate::instance::Instance;
use crate::scenario::Scenario;
use crate::solvers::{Budget, baseline, greedy};
use crate::stop::MaxIterations;

/// Scenarios of a cell, as they are or with every request required and in no haste, with greedy's tour of each.
fn drawn(cell: &str, required: bool, test: impl Fn(&Instance<'_>, &[u32])) {
    let cell: Cell = cell.parse().unwrap();
    for seed in 0..8 {
        let mut document = cell.draw(seed).unwrap();
        for request in document.requests.iter_mut().filter(|_| required) {
            (request.required, request.deadline_s) = (Some(true), None);
        }
        let scenario = Scenario::from_document(&document).unwrap();
        let instance = Instance::new(&scenario);
        let start = greedy::greedy(&instance, &mut Budget::new(&MaxIterations(u64::MAX)));
        test(&instance, &start);
    }
}

#[test]
fn a_share_that_ends_before_its_bounds_gives_the_baselines_tour() {
    let (hard, iterations) = (std::cell::Cell::new(0), 3_000);
    drawn("k_coverage/48/3/0.8", false, |instance, start| {
        let first = First::of(Effort::Share, instance, start);
        assert_eq!(first.whole, is_feasible(instance, start), "{start:?}");
        if !first.whole {
            return;
        }
        hard.set(hard.get() + 1);
        assert!(first.iterations > iterations);
        assert_eq!(
            First::of(Effort::Whole, instance, start),
            First { iterations: 60, whole: false }
        );
        let stop = MaxIterations(iterations);
        let rng = || Pcg64Mcg::seed_from_u64(0);
        let share = solve(instance, start, Effort::Share, &mut rng(), &mut Budget::new(&stop));
        let alone = baseline::search(instance, start, None, &mut rng(), &mut Budget::new(&stop));
        assert_eq!(share.order, alone.order);
        assert_ne!(share.order, start);
    });
    assert!(hard.get() > 0);
}

#[test]
fn bounds_come_early_where_the_proof_is_short() {
    for cell in ["k_coverage/32/2/0.2", "k_coverage/80/3/0.45", "reward/120/300000/1", "mobile/20"]
    {
        drawn(cell, false, |instance, start| {
            let first = First::of(Effort::Share, instance, start);
            assert!(!first.whole && first.iterations < 1_000, "{cell}: {first:?}");
        });
    }
}

#[test]
fn a_tour_of_all_candidates_is_not_searched_for_long() {
    let feasible = std::cell::Cell::new(0);
    drawn("k_coverage/80/3/0.45", true, |instance, start| {
        feasible.set(feasible.get() + u32::from(is_feasible(instance, start)));
        assert!(!First::of(Effort::Share, instance, start).whole, "{start:?}");
    });
    assert!(feasible.get() > 0);
}

#[test]
fn a_long_search_ends_with_a_whole_run() {
    assert!(long_search(30, 1_000_000) > long_search(20, 1_000_000));
    for stops in [0, 19, 30, 64, 1_000_000_000] {
        let iterations = long_search(stops, 36_000);
        assert!(iterations <= 90_000, "{stops}: {iterations}");
        assert_eq!(iterations, baseline::whole_runs(stops, iterations), "{stops}");
    }
}
