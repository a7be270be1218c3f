//! First-improvement descent over 2-opt and or-opt, restricted to near neighbours.

use super::Neighbours;
use super::or_opt::or_opt;
use super::two_opt::two_opt;
use crate::instance::Instance;
use crate::tour::Tour;

/// Near neighbours tried for each stop.
const NEAR: usize = 10;

/// Improves the order of a tour around the candidates in `dirty` until no move helps, or `moves` were
/// made; whether one was made.
pub fn descend(
    instance: &Instance<'_>,
    tour: &mut Tour,
    near: &mut Neighbours,
    dirty: &mut Vec<u32>,
    moves: usize,
) -> bool {
    let mut made = 0;
    while let Some(candidate) = dirty.pop() {
        let others = near.of(instance, candidate);
        let served = others.iter().copied().filter(|&other| tour.serves(other));
        let served: Vec<u32> = served.take(NEAR).collect();
        let ends = |tour: &Tour| {
            let at = tour.position(candidate)?;
            let beside = [at.checked_sub(1), Some(at + 1)].into_iter().flatten();
            Some(beside.filter_map(|p| tour.order().get(p).copied()).collect::<Vec<u32>>())
        };
        let reach = reach(instance, tour, candidate);
        for other in served {
            if instance.symmetric && near_m(instance, candidate, other) >= reach {
                break;
            }
            let beside = ends(tour).unwrap_or_default();
            if two_opt(instance, tour, candidate, other) || or_opt(instance, tour, candidate, other)
            {
                made += 1;
                dirty.extend(beside);
                dirty.extend(ends(tour).unwrap_or_default());
                dirty.extend([other, candidate]);
                break;
            }
        }
        if made >= moves {
            break;
        }
    }
    made > 0
}

/// The longer of the two edges at a stop. A new edge that is no shorter gains nothing that an
/// exchange seen from the other side would not (Bentley's neighbour list rule, 1992).
fn reach(instance: &Instance<'_>, tour: &Tour, candidate: u32) -> f64 {
    let Some(at) = tour.position(candidate) else { return 0.0 };
    if instance.moving {
        return f64::INFINITY;
    }
    let (before, after) = (tour.place_before(instance, at), tour.place(instance, at + 1));
    let here = candidate as usize;
    instance.distance_m(before, here).max(instance.distance_m(here, after))
}

fn near_m(instance: &Instance<'_>, a: u32, b: u32) -> f64 {
    if instance.moving { 0.0 } else { instance.distance_m(a as usize, b as usize) }
}
