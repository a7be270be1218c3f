//! Thin networks: whatever is closed, tours that cost less than the cutoff keep their arcs.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::incumbent::Incumbent;
use super::network::Network;
use super::{Aim, Model};
use crate::generate::{Reward, reward};
use crate::instance::Instance;
use crate::scenario::Scenario;
use crate::solvers::{Budget, baseline, mixed};
use crate::stop::MaxIterations;

/// Looks for tours, and at their arcs in a network for tours that cost a hair more. How many arcs that closes in all, and
/// how many there were each time.
fn closed(scenario: &Scenario, searches: &[u64]) -> (usize, usize) {
    let instance = Instance::new(scenario);
    let model = Model::new(&instance, Aim::Optimum);
    let whole = Network::new(&model, f64::INFINITY).arcs.len();
    let mut closed = 0;
    for &iterations in searches {
        let mut rng = Pcg64Mcg::seed_from_u64(iterations);
        let mut budget = Budget::new(&MaxIterations(u64::MAX));
        let found = baseline::search(&instance, &[], Some(iterations), &mut rng, &mut budget);
        let mut incumbent = Incumbent::none(&model);
        incumbent.offer(&model, found.order);
        let Some(order) = &incumbent.order else { continue };
        let cutoff = incumbent.cost + 1e-6 * (1.0 + incumbent.cost.abs());
        let network = Network::new(&model, cutoff);
        let mut from = instance.start();
        for &to in order {
            let arcs = &network.arcs[network.leaving(from)];
            assert!(arcs.iter().any(|arc| arc.to == to), "{:?}: {from} to {to}", scenario.name);
            from = to as usize;
        }
        closed += whole - network.arcs.len();
    }
    (closed, whole)
}

#[test]
fn a_better_tour_keeps_its_arcs() {
    let trials = std::env::var("VOLTOUR_TRIALS").map_or(300, |n| n.parse().unwrap());
    let mut mixtures = 0;
    for seed in 0..trials {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(9, seed)) else { continue };
        mixtures += u64::from(closed(&scenario, &[1, 100]).0 > 0);
    }
    println!("arcs closed in {mixtures}");
    assert!(20 * mixtures > trials, "{mixtures} of {trials}");
}

#[test]
fn most_arcs_of_a_dense_field_are_closed() {
    let dense = Reward { sensors: 80, side_m: 400.0, alpha: 1.0, ..Reward::default() };
    for seed in 0..5 {
        let scenario = Scenario::from_document(&reward(&dense, seed).unwrap()).unwrap();
        let (closed, whole) = closed(&scenario, &[2_000]);
        println!("{closed} of {whole}");
        assert!(2 * closed > whole, "seed {seed}: {closed} of {whole}");
    }
}
