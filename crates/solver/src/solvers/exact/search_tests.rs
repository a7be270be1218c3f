//! Dives and searches under the same bounds.

use super::incumbent::Incumbent;
use super::multipliers::Ascent;
use super::network::Network;
use super::prover::Prover;
use super::relaxation::{Reading, Resource};
use super::search::{End, Search};
use super::{Aim, Model};
use crate::generate::{KCoverage, Reward, k_coverage, reward};
use crate::instance::Instance;
use crate::scenario::{Document, Scenario};
use crate::solvers::Budget;
use crate::stop::MaxIterations;

/// What the tours cost that dives of these widths find; last, what a search proves to be the least.
fn costs(document: &Document, widths: &[usize]) -> Vec<f64> {
    let scenario = Scenario::from_document(document).unwrap();
    let instance = Instance::new(&scenario);
    let model = Model::new(&instance, Aim::Optimum);
    let network = Network::new(&model, f64::INFINITY);
    let stop = MaxIterations(10_000_000);
    let mut budget = Budget::new(&stop);
    let mut paths = Prover::paths(&model, &network, &Incumbent::none(&model), &mut budget).unwrap();
    let mut ascent = Ascent::new(&model, paths.resource() == Resource::Energy);
    let above = if model.length_counts { 2500.0 } else { 0.0 };
    for _ in 0..20 {
        ascent.climb(&model, &mut paths, above, &mut budget);
    }
    paths.read(Reading::Tours);
    paths.evaluate(&ascent.best.prices, &mut budget).unwrap();
    let dive = |width: &usize| {
        let mut incumbent = Incumbent::none(&model);
        let mut budget = Budget::new(&stop);
        Search::<2>::new(&model, &paths, &ascent.best, &mut incumbent).dive(*width, &mut budget);
        incumbent.cost
    };
    let mut costs: Vec<f64> = widths.iter().map(dive).collect();
    let mut incumbent = Incumbent::none(&model);
    let mut search = Search::<2>::new(&model, &paths, &ascent.best, &mut incumbent);
    let end = search.run(1_000_000, 1_000_000, &mut Budget::new(&stop));
    assert_eq!(end, End::Closed, "{:?}", scenario.name);
    costs.push(incumbent.cost);
    costs
}

#[test]
fn dives_find_good_tours_and_never_one_below_the_proof() {
    let covered = KCoverage { sensors: 24, k: 2, alpha: 0.4, ..KCoverage::default() };
    let prized = Reward { sensors: 14, alpha: 1.0, ..Reward::default() };
    let (mut found, mut lost) = (0.0, 0.0);
    for seed in 0..12 {
        for document in [k_coverage(&covered, seed).unwrap(), reward(&prized, seed).unwrap()] {
            let costs = costs(&document, &[1, 30, usize::MAX]);
            let &[one, some, all, least] = &costs[..] else { unreachable!() };
            assert!(
                all == least || (all - least).abs() <= 1e-6 * least.abs(),
                "seed {seed}: {costs:?}"
            );
            assert!(one.min(some) >= all.min(least), "seed {seed}: {costs:?}");
            if least.is_finite() && some.is_finite() {
                found += 1.0;
                lost += (some - least) / least.abs();
            }
        }
    }
    assert!(found >= 20.0, "{found} of 24");
    assert!(lost / found < 0.02, "{}", lost / found);
}
