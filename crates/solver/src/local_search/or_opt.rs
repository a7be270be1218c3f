//! Or-opt: up to three stops in a row move elsewhere, either way round (relocate for one stop).

use super::splice::{promising, splice};
use crate::instance::Instance;
use crate::tour::Tour;

/// Longest string that moves.
const LONGEST: usize = 3;

/// Tries to move a string that begins or ends with `candidate` next to `other`.
pub fn or_opt(instance: &Instance<'_>, tour: &mut Tour, candidate: u32, other: u32) -> bool {
    let (Some(at), Some(to)) = (tour.position(candidate), tour.position(other)) else {
        return false;
    };
    for length in 1..=LONGEST.min(tour.len()) {
        let strings = [(at, at + length), ((at + 1).saturating_sub(length), at + 1)];
        for (first, end) in strings.into_iter().take(if length == 1 { 1 } else { 2 }) {
            let outside = to < first || to >= end;
            if end > tour.len() || end - first != length || !outside {
                continue;
            }
            for gap in [to, to + 1] {
                if gap != first && gap != end && relocate(instance, tour, first, end, gap) {
                    return true;
                }
            }
        }
    }
    false
}

/// Moves the stops of `first..end` before the stop that is now at `gap`.
fn relocate(
    instance: &Instance<'_>,
    tour: &mut Tour,
    first: usize,
    end: usize,
    gap: usize,
) -> bool {
    let d = |a: usize, b: usize| instance.distance_m(a, b);
    let (head, tail) = (tour.place(instance, first), tour.place(instance, end - 1));
    let (before, after) = (tour.place_before(instance, first), tour.place(instance, end));
    let (left, right) = (tour.place_before(instance, gap), tour.place(instance, gap));
    let saved = d(before, head) + d(tail, after) - d(before, after) + d(left, right);
    let string = &tour.order()[first..end];
    let turned = if instance.symmetric {
        0.0
    } else {
        let turn = |w: &[u32]| d(w[1] as usize, w[0] as usize) - d(w[0] as usize, w[1] as usize);
        string.windows(2).map(turn).sum()
    };
    let ways = [
        (false, d(left, head) + d(tail, right) - saved),
        (true, d(left, tail) + d(head, right) + turned - saved),
    ];
    for (backwards, metres) in ways.into_iter().take(if end - first == 1 { 1 } else { 2 }) {
        if !promising(instance, tour, metres) {
            continue;
        }
        let mut moved: Vec<u32> = tour.order()[first..end].to_vec();
        if backwards {
            moved.reverse();
        }
        let order = tour.order();
        let (from, stops) = if gap < first {
            (gap, [&moved[..], &order[gap..first]].concat())
        } else {
            (first, [&order[end..gap], &moved[..]].concat())
        };
        if splice(instance, tour, from, &stops) {
            return true;
        }
    }
    false
}
