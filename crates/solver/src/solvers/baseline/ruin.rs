//! Ruin: which stops leave the tour.
//!
//! Adjacent string removal as in Christiaens and Vanden Berghe, "Slack Induction by String Removals"
//! (2020). Deviations: 1. there is one tour, so several strings are cut from it, each around another
//! neighbour of the seed; 2. the seed may be a candidate that is not served; 3. at random, single stops
//! or one long string leave instead.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use crate::instance::Instance;
use crate::local_search::Neighbours;
use crate::tour::Tour;

/// Most stops that leave at once.
const MOST: usize = 16;
/// From tours of up to so many stops, all may leave.
const SMALL: usize = 6;
/// Longest string.
const STRING: usize = 10;

/// Marks the stops that leave; `leaves` is by candidate and all false before. Returns them.
pub fn ruin(
    instance: &Instance<'_>,
    tour: &Tour,
    near: &mut Neighbours,
    rng: &mut Pcg64Mcg,
    leaves: &mut [bool],
) -> Vec<u32> {
    let stops = tour.len();
    if stops == 0 {
        return Vec::new();
    }
    let most = (stops * 2 / 5).clamp(SMALL.min(stops), MOST);
    let count = rng.random_range(1..=most);
    let mut removed = Vec::with_capacity(count);
    let mut leave = |candidate: u32, removed: &mut Vec<u32>| {
        if !std::mem::replace(&mut leaves[candidate as usize], true) {
            removed.push(candidate);
        }
    };
    match rng.random_range(0..10) {
        0 | 1 => {
            for _ in 0..count {
                leave(tour.order()[rng.random_range(0..stops)], &mut removed);
            }
        }
        2 | 3 => {
            let from = rng.random_range(0..=stops - count);
            for &candidate in &tour.order()[from..from + count] {
                leave(candidate, &mut removed);
            }
        }
        _ => {
            let seed = rng.random_range(0..instance.len() as u32);
            let longest = STRING.min(stops).min(count);
            let around = std::iter::once(seed).chain(near.of(instance, seed).iter().copied());
            for centre in around {
                let Some(at) = tour.position(centre) else { continue };
                if removed.len() >= count {
                    break;
                }
                if removed.contains(&centre) {
                    continue;
                }
                let length = rng.random_range(1..=longest).min(count - removed.len());
                let first = (at + 1).saturating_sub(length);
                let from = rng.random_range(first..=at.min(stops - length));
                for &candidate in &tour.order()[from..from + length] {
                    leave(candidate, &mut removed);
                }
            }
        }
    }
    removed
}
