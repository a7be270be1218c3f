//! Replaces a stretch of a tour by the same stops in another order, if that is legal and cheaper.

use crate::instance::Instance;
use crate::tour::{Run, Tour};

/// Saves less than this share of the tour: rounding, not an improvement.
const LEAST: f64 = 1e-9;

/// Whether a change of length is worth a look at the schedule. Where waiting or motion decides, a
/// longer way may still be the better one, but only time windows make that worth a simulation.
pub fn promising(instance: &Instance<'_>, tour: &Tour, metres: f64) -> bool {
    instance.moving || metres < -LEAST * tour.finished().distance_m
}

/// What a whole tour takes of the scarce resource.
pub fn effort(instance: &Instance<'_>, finished: &Run) -> f64 {
    let per = &instance.effort;
    per.per_m * finished.distance_m + per.per_s * finished.arrive_s + per.per_j * finished.charge_j
}

/// Puts `stops` at `from`, if the tour is then legal and takes less.
pub fn splice(instance: &Instance<'_>, tour: &mut Tour, from: usize, stops: &[u32]) -> bool {
    let now = effort(instance, tour.finished());
    let Some(end) = tour.rearranged(instance, from, stops) else { return false };
    let better = effort(instance, &end) < now - LEAST * now.abs();
    if better {
        tour.reorder(instance, from, stops);
    }
    better
}
