//! Re-insertion: the stops that an episode chose, put together anew in other orders.
//!
//! Most of what a greedy roll-out misses is the order, not the choice of stops, for early insertions stay where
//! they are. Putting the same stops in again, in random orders, each at its cheapest legal place, mends
//! that without a network and without local search.

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

use super::Kept;
use crate::framework::{Definition, Insert, State};
use crate::instance::Instance;
use crate::solvers::gain;

/// How far the orders by deadline stray from it, as a share of the deadline.
const STRAY: f64 = 0.5;

/// Puts the stops of a tour in again, in `times` orders: any, and about that of their deadlines, by turns. A
/// tour is complete as soon as its demands are met; where stops are worth something in themselves, what is won is
/// filled with others, the best gain for effort first. Every tour goes to `kept`.
pub fn reinsert(
    instance: &Instance<'_>,
    definition: &dyn Definition,
    stops: &[u32],
    times: usize,
    rng: &mut Pcg64Mcg,
    kept: &mut Kept,
) {
    let mut order = stops.to_vec();
    let empty = State::new(instance);
    let due = stops.iter().any(|&c| instance.candidates[c as usize].due_s.is_finite());
    for turn in 0..times {
        order.shuffle(rng);
        if turn % 2 == 1 && due {
            sort_about_deadlines(instance, &mut order, rng);
        }
        let mut state = empty.clone();
        for &candidate in &order {
            if state.helps(candidate)
                && let Some(place) = state.place(candidate, Insert::Cheapest)
            {
                state.insert(candidate, place.insertion.position);
            }
        }
        fill(definition, &mut state);
        kept.offer(instance, state.tour());
    }
}

/// Sorts stops by their deadlines, each as if it were up to a share earlier or later.
fn sort_about_deadlines(instance: &Instance<'_>, order: &mut [u32], rng: &mut Pcg64Mcg) {
    let mut keyed: Vec<(f64, u32)> = Vec::with_capacity(order.len());
    for &candidate in order.iter() {
        let stray = 1.0 + STRAY * (2.0 * rng.random::<f64>() - 1.0);
        keyed.push((instance.candidates[candidate as usize].due_s * stray, candidate));
    }
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.iter_mut().zip(keyed).for_each(|(place, (_, candidate))| *place = candidate);
}

/// Inserts what still helps, the best gain for effort first.
fn fill(definition: &dyn Definition, state: &mut State<'_>) {
    while !definition.stops(state) {
        let mut best: Option<(f64, u32, usize)> = None;
        for &candidate in state.useful() {
            if state.tour().serves(candidate) || !state.helps(candidate) {
                continue;
            }
            let Some(place) = state.place(candidate, Insert::Cheapest) else { continue };
            let worth = gain(state.instance(), candidate).max(1e-9);
            let ratio = worth / place.insertion.effort.max(1e-9);
            if best.is_none_or(|(most, ..)| ratio > most) {
                best = Some((ratio, candidate, place.insertion.position));
            }
        }
        let Some((_, candidate, position)) = best else { return };
        state.insert(candidate, position);
    }
}
