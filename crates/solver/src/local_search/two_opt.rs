//! 2-opt: two edges leave, what lies between them is travelled backwards.

use super::splice::{promising, splice};
use crate::instance::Instance;
use crate::tour::Tour;

/// Tries to make `other` the neighbour of `candidate`, behind it and before it.
pub fn two_opt(instance: &Instance<'_>, tour: &mut Tour, candidate: u32, other: u32) -> bool {
    let (Some(a), Some(b)) = (tour.position(candidate), tour.position(other)) else { return false };
    let (low, high) = (a.min(b), a.max(b));
    // Behind: the stretch after the first of the two up to the second; before: its mirror image.
    reverse(instance, tour, low + 1, high) || (high > 0 && reverse(instance, tour, low, high - 1))
}

/// Travels the stops from `first` to `last` backwards.
fn reverse(instance: &Instance<'_>, tour: &mut Tour, first: usize, last: usize) -> bool {
    if first >= last {
        return false;
    }
    let d = |a: usize, b: usize| instance.distance_m(a, b);
    let before = tour.place_before(instance, first);
    let after = tour.place(instance, last + 1);
    let (head, tail) = (tour.place(instance, first), tour.place(instance, last));
    let mut metres = d(before, tail) + d(head, after) - d(before, head) - d(tail, after);
    if !instance.symmetric {
        let pairs = tour.order()[first..=last].windows(2);
        let turned = |w: &[u32]| d(w[1] as usize, w[0] as usize) - d(w[0] as usize, w[1] as usize);
        metres += pairs.map(turned).sum::<f64>();
    }
    if !promising(instance, tour, metres) {
        return false;
    }
    let stops: Vec<u32> = tour.order()[first..=last].iter().rev().copied().collect();
    splice(instance, tour, first, &stops)
}
