//! The charger after some stops, and the simulation of a whole tour.

use crate::instance::Instance;
use crate::scenario::Point;

/// The charger when it leaves a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// The candidate it leaves, or the start, or the end.
    pub node: u32,
    /// Where that is.
    pub place: Point,
    /// When charging began there, in seconds.
    pub arrive_s: f64,
    /// When it leaves, in seconds.
    pub depart_s: f64,
    /// Travelled since the start, in metres.
    pub distance_m: f64,
    /// Delivered since the start, in joules.
    pub charge_j: f64,
}

/// The run after each stop of `order` and, last, at the end; whether all of it is legal
/// (constraints 1 to 3).
pub fn simulate(instance: &Instance<'_>, order: &[u32]) -> (Vec<Run>, bool) {
    let mut run = instance.departure();
    let mut legal = true;
    let mut runs = Vec::with_capacity(order.len() + 1);
    for &next in order {
        run = instance.step(&run, next);
        legal &= instance.in_time(&run);
        runs.push(run);
    }
    run = instance.finish(&run);
    runs.push(run);
    (runs, legal && instance.keeps_limits(&run))
}
