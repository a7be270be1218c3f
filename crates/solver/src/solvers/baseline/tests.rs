//! The search against the enumeration, on instances small enough for both.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::search::{first_run, fitted, search, whole_runs};
use crate::instance::Instance;
use crate::scenario::Scenario;
use crate::solvers::{Budget, enumerate::enumerate, mixed};
use crate::stop::MaxIterations;
use crate::tolerance::agrees;
use crate::tour::{Tour, Value};

#[path = "../../../tests/golden/mod.rs"]
mod golden;

/// How often the search may miss the best tour: without the triangle inequality a set of stops may be
/// legal though none of its subsets is.
const MISSES: usize = 15;

#[test]
fn the_search_finds_what_the_enumeration_finds() {
    let mut missed = Vec::new();
    for seed in 0..600 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(6, seed)) else { continue };
        let instance = Instance::new(&scenario);
        let mut budget = Budget::new(&MaxIterations(u64::MAX));
        let Some(best) = enumerate(&instance, &mut budget) else { continue };
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut budget = Budget::new(&MaxIterations(20_000));
        let found = search(&instance, &[], None, &mut rng, &mut budget).order;
        let value = |order: &[u32]| Value::of(&instance, &Tour::new(&instance, order));
        assert!(!value(&found).beats(&value(&best)), "{:?}", scenario.name);
        if !Tour::new(&instance, &found).is_legal() || value(&best).beats(&value(&found)) {
            missed.push((scenario.name.clone(), value(&best), value(&found), instance.metric));
        }
    }
    let metric: Vec<_> = missed.iter().filter(|(.., metric)| *metric).collect();
    assert!(metric.is_empty(), "{metric:?}");
    assert!(missed.len() <= MISSES, "{}: {missed:?}", missed.len());
}

#[test]
fn golden_scenarios_keep_their_optimum() {
    for (name, optimum) in golden::GOLDEN {
        let path = format!("{}/tests/golden/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let scenario = Scenario::from_json(&std::fs::read(path).unwrap()).unwrap();
        let instance = Instance::new(&scenario);
        let mut budget = Budget::new(&MaxIterations(u64::MAX));
        let best = enumerate(&instance, &mut budget).unwrap();
        let mut rng = Pcg64Mcg::seed_from_u64(0);
        let found = search(&instance, &[], None, &mut rng, &mut budget).order;
        for order in [best, found] {
            let value = Value::of(&instance, &Tour::new(&instance, &order));
            assert!(value.is_feasible() && agrees(value.cost.abs(), optimum), "{name}: {value:?}");
        }
    }
}

#[test]
fn the_last_run_ends_with_the_iterations() {
    for (length, iterations) in [(1_000, 400), (1_000, 1_999), (1_000, 3_000), (800, 100_000)] {
        let first = fitted(length, iterations);
        let runs = || {
            (0..64).scan(0, |sum, run| {
                (*sum < iterations).then(|| {
                    *sum += first << run;
                    *sum
                })
            })
        };
        let (count, end) = (runs().count(), runs().last().unwrap());
        assert!(end - iterations < 1 << count, "{end} for {iterations}");
        assert!(count == 1 || first >= length && first < 3 * length, "{first} for {iterations}");
    }
    assert_eq!(fitted(1_000, 0), 1);
}

#[test]
fn whole_runs_are_fitted_as_they_are() {
    for stops in [0, 5, 12, 23, 60, 1_000] {
        let length = first_run(stops);
        for iterations in [1, 300, 1_000, 1_500, 7_000, 20_000, 100_000] {
            let whole = whole_runs(stops, iterations);
            assert!(
                2 * whole >= iterations && 2 * whole <= 5 * iterations,
                "{iterations}: {whole}"
            );
            let less_than_one = whole == iterations && whole < length;
            assert!(less_than_one || fitted(length, whole) == length, "{iterations}: {whole}");
        }
    }
}
