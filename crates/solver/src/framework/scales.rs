//! [`Scales`]: the units of an instance, so that nothing that a policy sees depends on metres or seconds.

use crate::instance::Instance;
use crate::solvers::gain;

/// The units of an instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Mean distance between two of start and useful candidates (moving ones where they are at time 0), in metres.
    pub length_m: f64,
    /// Mean time to charge a useful candidate at time 0 and to travel one length, in seconds.
    pub time_s: f64,
    /// Mean gain of a useful candidate in the objective; 1 where gains do not count.
    pub gain: f64,
    /// Mean effort of a useful candidate: to charge it, and to travel half a length for it.
    pub effort: f64,
}

impl Scales {
    /// The units of an instance of which these candidates are useful.
    pub fn new(instance: &Instance<'_>, useful: &[u32]) -> Self {
        let charger = &instance.scenario.charger;
        let count = useful.len().max(1) as f64;
        let places: Vec<usize> =
            useful.iter().map(|&c| c as usize).chain([instance.start()]).collect();
        let distance = |&a: &usize, &b: &usize| instance.distance_m(a, b);
        let total: f64 =
            places.iter().map(|a| places.iter().map(|b| distance(a, b)).sum::<f64>()).sum();
        let pairs = places.len() * places.len().saturating_sub(1);
        let length_m = positive(total / pairs.max(1) as f64);
        let charge = |&c: &u32| instance.candidates[c as usize].charge_j(0.0);
        let charge_j = useful.iter().map(charge).sum::<f64>() / count;
        let charge_s = charge_j / charger.transfer_w;
        let gains: f64 = useful.iter().map(|&c| gain(instance, c)).sum::<f64>() / count;
        let (half_m, per) = (0.5 * length_m, &instance.effort);
        let half_s = half_m / charger.speed_mps;
        let effort = per.per_m * half_m + per.per_s * (half_s + charge_s) + per.per_j * charge_j;
        Self {
            length_m,
            time_s: positive(charge_s + length_m / charger.speed_mps),
            gain: positive(gains),
            effort: positive(effort),
        }
    }
}

/// The value, or 1 where it is no unit.
fn positive(value: f64) -> f64 {
    if value.is_finite() && value > 1e-9 { value } else { 1.0 }
}
