//! Relaxed paths: whatever is closed, however often times are split and demands counted, the best tour stays a path.

use super::layers::resource;
use super::memory::Memory;
use super::multipliers::Ascent;
use super::network::Network;
use super::relaxation::{Reading, Relaxation, Resource};
use super::tally::Tally;
use super::{Aim, Model};
use crate::generate::{KCoverage, Reward, k_coverage, reward};
use crate::instance::Instance;
use crate::scenario::{Document, Objective, Scenario};
use crate::solvers::{Budget, Options, SolverName, solve};
use crate::stop::MaxIterations;
use crate::tolerance::tolerance;

/// Proves the best tour, then closes whatever costs a hair more, again and again over finer layers.
fn bounds_stay_below(document: &Document, intervals: usize) -> bool {
    let scenario = Scenario::from_document(document).unwrap();
    let stop = MaxIterations(100_000);
    let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
    let plan = solve(&scenario, &options).unwrap().plan;
    if plan.status.name() != "optimal" || plan.stops.is_empty() {
        return false;
    }
    let sign = if scenario.objective == Objective::MinDistance { 1.0 } else { -1.0 };
    let best = sign * plan.objective;
    let above = best + 4.0 * tolerance(best);
    let instance = Instance::new(&scenario);
    let model = Model::new(&instance, Aim::Optimum);
    let network = Network::new(&model, f64::INFINITY);
    let memory = Memory::nearest(&network, |a, b| model.wide.distance_m(a, b), 3);
    let resource = resource(&model);
    let horizon = match resource {
        Resource::Energy => model.wide.capacity_j,
        _ => model.wide.candidates.iter().map(|c| c.due_s).fold(0.0, f64::max),
    };
    if !horizon.is_finite() {
        return false;
    }
    let mut budget = Budget::new(&stop);
    let budget = &mut budget;
    let paths = Relaxation::new(&model, &network, resource, intervals, horizon, memory, budget);
    let mut paths = paths.unwrap();
    let mut ascent = Ascent::new(&model, resource == Resource::Energy);
    for _ in 0..4 {
        paths.read(Reading::Paths);
        ascent.restart();
        ascent.best.bound = f64::NEG_INFINITY;
        for _ in 0..12 {
            ascent.climb(&model, &mut paths, above, budget);
            let bound = ascent.best.bound;
            assert!(bound <= above, "{:?}: {bound} over {above}", scenario.name);
        }
        for reading in [Reading::Tours, Reading::Paths] {
            paths.read(reading);
            paths.evaluate(&ascent.best.prices, budget).unwrap();
            let most = above - ascent.best.constant + ascent.best.rounding;
            assert!(paths.fix(&ascent.best.prices, most, budget));
        }
        if resource == Resource::Stops {
            break;
        }
        assert!(paths.split(&model, budget));
        if let Some(demand) = ascent.loosest(&model)
            && paths.tally().states * (model.demands[demand].needs as usize + 1) <= 32
        {
            let demands = paths.tally().demands.iter().copied().chain([demand]).collect();
            ascent.count(&model, demand);
            paths.refine(paths.memory().clone(), Tally::new(&model, demands));
        }
    }
    true
}

#[test]
fn no_split_loses_the_best_tour() {
    let trials = std::env::var("VOLTOUR_TRIALS").map_or(12, |n| n.parse().unwrap());
    let mut proven = 0;
    for seed in 0..trials {
        let covered = KCoverage { sensors: 24, k: 2, alpha: 0.7, ..KCoverage::default() };
        let prized = Reward { sensors: 30, alpha: 1.0, ..Reward::default() };
        for intervals in [5, 8, 13] {
            proven += u32::from(bounds_stay_below(&k_coverage(&covered, seed).unwrap(), intervals));
            proven += u32::from(bounds_stay_below(&reward(&prized, seed).unwrap(), intervals));
        }
    }
    println!("{proven} proven");
    assert!(u64::from(proven) > trials);
}
