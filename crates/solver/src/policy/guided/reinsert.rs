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
use crate::tour::Value;

/// How far the orders by deadline stray from it, as a share of the deadline.
const STRAY: f64 = 0.5;

/// How many places a stop strays, at most, in the orders about the best so far.
const SHIFT: f64 = 6.0;

/// Puts the stops of a tour in again, in `times` orders: any, about that of their deadlines, and half of them
/// about the one that gave the best tour so far. A tour is complete as soon as its demands are met; where stops are worth something in themselves, what is won is
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
    let mut best: Option<(Value, Vec<u32>)> = None;
    let empty = State::new(instance);
    let due = stops.iter().any(|&c| instance.candidates[c as usize].due_s.is_finite());
    for turn in 0..times {
        match (&best, turn % 4) {
            (Some((_, found)), 2 | 3) => {
                order.copy_from_slice(found);
                sort_by(&mut order, |place, _| place as f64 + stray(SHIFT, rng));
            }
            (_, 1) if due => sort_by(&mut order, |_, candidate| {
                instance.candidates[candidate as usize].due_s * (1.0 + stray(STRAY, rng))
            }),
            _ => order.shuffle(rng),
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
        let value = Value::of(instance, state.tour());
        if best.as_ref().is_none_or(|(most, _)| value.beats(most)) {
            best = Some((value, order.clone()));
        }
    }
}

/// Sorts stops by a key of each, which may depend on its place.
fn sort_by(order: &mut [u32], mut key: impl FnMut(usize, u32) -> f64) {
    let mut keyed: Vec<(f64, u32)> = order
        .iter()
        .enumerate()
        .map(|(place, &candidate)| (key(place, candidate), candidate))
        .collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.iter_mut().zip(keyed).for_each(|(place, (_, candidate))| *place = candidate);
}

/// A number from -most to most.
fn stray(most: f64, rng: &mut Pcg64Mcg) -> f64 {
    most * (2.0 * rng.random::<f64>() - 1.0)
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
