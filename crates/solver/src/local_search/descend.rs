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
        for other in served {
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
