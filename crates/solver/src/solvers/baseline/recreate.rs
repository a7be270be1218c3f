//! Recreate: who comes into the tour, and where.
//!
//! Insertion in an order drawn from several, at the cheapest legal place, with blinks (Christiaens and
//! Vanden Berghe, 2020); or the step-by-step insertion of [`grow`] with noise.

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

use super::cost::Cost;
use crate::instance::Instance;
use crate::local_search::Neighbours;
use crate::solvers::grow::{Rule, grow};
use crate::solvers::partial::{Partial, gain};
use crate::tour::Insertion;

/// A place is overlooked this often.
const BLINK: f64 = 0.01;
/// A stop that is worth nothing comes in this often where two such may be a short cut.
const DETOUR: f64 = 0.05;
/// Tours up to this length are searched whole for a place; longer ones next to near stops.
const WHOLE: usize = 40;
/// Near stops tried in longer tours.
const NEAR: usize = 10;

/// Fills a ruined tour from `pool`.
pub fn recreate(
    instance: &Instance<'_>,
    partial: &mut Partial,
    pool: &mut Vec<u32>,
    cost: &Cost,
    near: &mut Neighbours,
    rng: &mut Pcg64Mcg,
) {
    // Without the triangle inequality a stop that is worth nothing may still be a short cut.
    let detours = !instance.metric;
    pool.retain(|&c| !partial.tour.serves(c) && (detours || cost.is_worth(instance, partial, c)));
    pool.shuffle(rng);
    let by = rng.random_range(0..8);
    if by == 0 && pool.len() * partial.tour.len() < 2000 {
        let power = rng.random_range(0.5..1.5);
        let must_first = rng.random_bool(0.5);
        let rule = Rule { weight: &cost.weight, unit: 1.0, must_first, power };
        grow(instance, partial, pool, &rule, || rng.random_range(0.7..1.3), None);
        return;
    }
    sort(instance, partial, pool, cost, by, near, rng);
    for &candidate in pool.iter() {
        let worthless = !cost.is_worth(instance, partial, candidate);
        if worthless && !detours {
            continue;
        }
        if let Some(place) = place(instance, partial, candidate, near, rng)
            && (!worthless || place.effort < 0.0 || rng.random_bool(DETOUR))
        {
            partial.insert(instance, place.position, candidate);
        }
    }
}

/// Orders the pool, which is in random order before.
fn sort(
    instance: &Instance<'_>,
    partial: &Partial,
    pool: &mut Vec<u32>,
    cost: &Cost,
    by: u32,
    near: &mut Neighbours,
    rng: &mut Pcg64Mcg,
) {
    let candidate = |c: u32| &instance.candidates[c as usize];
    let start = instance.scenario.charger.start_m;
    match by {
        1 | 2 => {}
        3 => pool.sort_by(|&a, &b| candidate(a).due_s.total_cmp(&candidate(b).due_s)),
        4 => sort_down(pool, |c| (candidate(c).point - start).norm()),
        5 => sort_down(pool, |c| cost.worth(instance, partial, c)),
        _ => {
            let noise: f64 = rng.random_range(0.0..0.5);
            let mut keyed: Vec<(f64, u32)> = Vec::with_capacity(pool.len());
            for &c in pool.iter() {
                let place = place(instance, partial, c, near, rng);
                // Who has no legal place now has none later, if a detour is never a short cut.
                if place.is_none() && instance.metric {
                    continue;
                }
                let effort = place.map_or(f64::INFINITY, |place| place.effort);
                let factor = 1.0 + noise * rng.random_range(-1.0..1.0);
                let worth = cost.worth(instance, partial, c);
                keyed.push((factor * worth / effort.max(1e-9), c));
            }
            keyed.sort_by(|a, b| b.0.total_cmp(&a.0));
            pool.clear();
            pool.extend(keyed.iter().map(|&(_, c)| c));
        }
    }
}

fn sort_down(pool: &mut [u32], mut key: impl FnMut(u32) -> f64) {
    pool.sort_by_cached_key(|&c| {
        // Descending, total: the sign bit trick of `total_cmp`.
        let bits = key(c).to_bits() as i64;
        std::cmp::Reverse(bits ^ (((bits >> 63) as u64) >> 1) as i64)
    });
}

/// The cheapest legal place that is not overlooked.
fn place(
    instance: &Instance<'_>,
    partial: &Partial,
    candidate: u32,
    near: &mut Neighbours,
    rng: &mut Pcg64Mcg,
) -> Option<Insertion> {
    let tour = &partial.tour;
    if instance.untimed && tour.len() <= WHOLE {
        return tour.shortest(instance, candidate, || rng.random_bool(BLINK));
    }
    let mut best: Option<Insertion> = None;
    let mut attempt = |position: usize, rng: &mut Pcg64Mcg| {
        let most = best.map_or(f64::INFINITY, |old| old.effort);
        if let Some(new) = tour.insertion_below(instance, position, candidate, most)
            && !rng.random_bool(BLINK)
        {
            best = Some(new);
        }
    };
    if tour.len() <= WHOLE {
        for position in 0..tour.in_time_until(instance, candidate) {
            attempt(position, rng);
        }
        return best;
    }
    attempt(0, rng);
    attempt(tour.len(), rng);
    let beside = near.of(instance, candidate).iter().filter_map(|&other| tour.position(other));
    for position in beside.take(NEAR) {
        attempt(position, rng);
        attempt(position + 1, rng);
    }
    if best.is_none() && gain(instance, candidate) <= 0.0 {
        return tour.cheapest(instance, candidate);
    }
    best
}
