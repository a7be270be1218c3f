//! The 4-approximation of the largest reward within a capacity (paper, section "Fully Charging Reward
//! Maximization Problem", after W. Liang et al., "Approximation algorithms for charging reward
//! maximization", 2017): a reduction to the orienteering problem.
//!
//! 1. Nodes' costs move onto edges: half of the energy that each end is charged with is added to the energy
//!    travelled along the edge. The triangle inequality stays, and the length of a path from the start to the
//!    end is the energy of the tour.
//! 2. Rewards become whole numbers from 1 to n^2.
//! 3. The orienteering problem from the start to the end with the capacity as the bound (`orienteering`).
//!
//! Deviation: what cannot be afforded even as the only stop, or is worth nothing, is left out before the
//! rewards are scaled, so that scaling costs no more than one n-th of the optimum.

use super::orienteering::{Graph, orienteering};
use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::paper::{Attempt, PaperOptions, Unfinished, fitted};

pub(super) fn app(
    instance: &Instance<'_>,
    options: &PaperOptions,
    budget: &mut Budget<'_>,
) -> Attempt {
    let sites: Vec<u32> = (0..instance.len() as u32).filter(|&c| is_worth(instance, c)).collect();
    let places = sites.len() + 2;
    let graph_bytes = places.saturating_mul(places).saturating_mul(size_of::<f64>());
    let Some(memory) = options.memory_bytes.checked_sub(graph_bytes) else {
        return Attempt::ended_by(Unfinished::Memory);
    };
    match orienteering(&reduction(instance, &sites), memory, budget) {
        Ok(path) => {
            let order: Vec<u32> = path.iter().map(|&site| sites[site]).collect();
            let order_that_fits = fitted(instance, &order);
            debug_assert_eq!(
                order_that_fits, order,
                "the length of a path is the energy of its tour"
            );
            Attempt::finished(order_that_fits)
        }
        Err(limit) => Attempt::ended_by(limit),
    }
}

/// Whether a candidate is worth something and affordable as the only stop.
fn is_worth(instance: &Instance<'_>, candidate: u32) -> bool {
    let only = instance.finish(&instance.step(&instance.departure(), candidate));
    instance.candidates[candidate as usize].reward > 0.0 && instance.keeps_limits(&only)
}

/// The orienteering problem: the sites, then the start, then the end.
fn reduction(instance: &Instance<'_>, sites: &[u32]) -> Graph {
    let most = sites.iter().map(|&c| instance.candidates[c as usize].reward).fold(0.0, f64::max);
    let levels = (sites.len() * sites.len()) as f64;
    let scaled = |&c: &u32| {
        let level = (instance.candidates[c as usize].reward / most * levels).floor();
        level.clamp(1.0, levels) as u64
    };
    let place = |i: usize| match sites.get(i) {
        Some(&site) => (site as usize, instance.candidates[site as usize].charge_j(0.0)),
        None if i == sites.len() => (instance.start(), 0.0),
        None => (instance.end(), 0.0),
    };
    let travel_jpm = instance.scenario.charger.travel_jpm;
    let edge = |a: usize, b: usize| {
        let ((from, from_j), (to, to_j)) = (place(a), place(b));
        if a == b {
            0.0
        } else {
            travel_jpm * instance.distance_m(from, to) + (from_j + to_j) / 2.0
        }
    };
    let size = sites.len() + 2;
    Graph {
        lengths: (0..size * size).map(|i| edge(i / size, i % size)).collect(),
        size,
        rewards: sites.iter().map(scaled).chain([0, 0]).collect(),
        // The same sum in another order differs in its last digits.
        bound: instance.capacity_j * (1.0 - 1e-12),
    }
}
