//! The quick bounds against proven optima, on small scenarios of every kind.

use super::quick::{Care, quick};
use super::{Aim, Model};
use crate::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use crate::instance::Instance;
use crate::scenario::{Objective, Scenario};
use crate::solvers::{Options, SolverName, mixed, solve};
use crate::stop::MaxIterations;
use crate::tolerance::tolerance;

/// The quick bound, and the best cost where it is proven; infinite without a feasible tour.
fn both(scenario: &Scenario) -> Option<(f64, f64)> {
    let plan = {
        let stop = MaxIterations(100_000);
        let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
        solve(scenario, &options).unwrap().plan
    };
    let sign = if scenario.objective == Objective::MinDistance { 1.0 } else { -1.0 };
    let best = match plan.status.name() {
        "optimal" => sign * plan.objective,
        "infeasible" => f64::INFINITY,
        _ => return None,
    };
    let instance = Instance::new(scenario);
    let model = Model::new(&instance, Aim::Optimum);
    let bound = quick(&model, best, Care::Whole);
    let hasty = quick(&model, best, Care::Little);
    assert!(hasty <= best + tolerance(best), "{:?}: {hasty} {best}", scenario.name);
    let blind = quick(&model, f64::INFINITY, Care::Whole);
    assert!(blind <= best + tolerance(best), "{:?}: {blind} {best}", scenario.name);
    Some((bound, best))
}

#[test]
fn no_tour_is_better() {
    let trials = std::env::var("VOLTOUR_TRIALS").map_or(600, |n| n.parse().unwrap());
    let (mut proven, mut near) = (0, 0);
    for seed in 0..trials {
        let n = 1 + seed as usize % 10;
        let Ok(scenario) = Scenario::from_document(&mixed::draw(n, 7_000 + seed)) else {
            continue;
        };
        let Some((bound, best)) = both(&scenario) else { continue };
        assert!(bound <= best + tolerance(best), "{:?}: {bound} {best}", scenario.name);
        proven += 1;
        near += u32::from(bound >= best - 0.1 * best.abs());
    }
    println!("{proven} proven, {near} bounds within 10 %");
    assert!(2 * proven > trials);
}

#[test]
fn no_tour_of_a_preset_is_better() {
    let covered = KCoverage { sensors: 48, k: 2, alpha: 0.3, ..KCoverage::default() };
    let prized = Reward { sensors: 14, alpha: 1.0, ..Reward::default() };
    let moving = Mobile { sensors: 10, timespan_s: 600.0, ..Mobile::default() };
    let mut proven = 0;
    for seed in 0..12 {
        let drawn = [k_coverage(&covered, seed), reward(&prized, seed), mobile(&moving, seed)];
        for document in drawn {
            let scenario = Scenario::from_document(&document.unwrap()).unwrap();
            let Some((bound, best)) = both(&scenario) else { continue };
            assert!(bound <= best + tolerance(best), "{:?}: {bound} {best}", scenario.name);
            println!("{:?}: {bound} {best}", scenario.name);
            proven += 1;
        }
    }
    assert!(proven >= 30, "{proven}");
}
