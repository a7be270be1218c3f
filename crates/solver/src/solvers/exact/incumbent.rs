//! The best tour that a proof has, and what another must cost to be worth looking for.

use super::model::{Aim, Model};
use crate::instance::Demand;
use crate::tolerance::tolerance;
use crate::tour::simulate;

/// The best tour so far.
#[derive(Clone, Debug)]
pub struct Incumbent {
    /// Its candidates in order; none if no feasible tour is known.
    pub order: Option<Vec<u32>>,
    /// Its cost; infinite if none is known.
    pub cost: f64,
    /// The least cost of a tour that only the check's tolerance allows, not a solver's.
    pub beyond: f64,
    /// Whether so long a search has come before it that a proof need not wait for another.
    pub searched: bool,
    /// All costs are whole multiples of this; 0 if unknown.
    grain: f64,
    any: bool,
}

impl Incumbent {
    pub fn none(model: &Model<'_>) -> Self {
        Self {
            order: None,
            cost: f64::INFINITY,
            beyond: f64::INFINITY,
            searched: false,
            grain: grain(model),
            any: model.aim == Aim::AnyTour,
        }
    }

    /// Tours that cost this much or more are of no interest.
    #[inline]
    pub fn cutoff(&self) -> f64 {
        if self.cost == f64::INFINITY {
            return if self.any { 1e-7 } else { f64::INFINITY };
        }
        self.cost - (0.5 * tolerance(self.cost)).max(self.grain - 1e-6)
    }

    /// Whether any tour does, and one is known.
    pub fn suffices(&self) -> bool {
        self.any && self.order.is_some()
    }

    /// Takes a solver's tour if it is feasible and better.
    pub fn offer(&mut self, model: &Model<'_>, order: Vec<u32>) {
        let met =
            |d: &Demand| d.members.iter().filter(|m| order.contains(m)).count() >= d.needs as usize;
        if simulate(model.strict, &order).1 && model.demands.iter().all(met) {
            self.offer_wide(model, order);
        }
    }

    /// Takes a tour that meets every demand within the check's tolerance, if it is better and keeps a solver's
    /// limits too.
    pub fn offer_wide(&mut self, model: &Model<'_>, order: Vec<u32>) {
        let (runs, legal) = simulate(model.strict, &order);
        let gain = order.iter().map(|&c| model.gains[c as usize]).sum();
        let cost = model.cost(runs.last().map_or(0.0, |run| run.distance_m), gain);
        if !legal {
            self.beyond = self.beyond.min(cost);
        } else if cost < self.cost {
            self.cost = cost;
            self.order = Some(order);
        }
    }
}

/// The largest whole number of which all costs are multiples; 0 if they are not whole.
fn grain(model: &Model<'_>) -> f64 {
    let instance = &model.wide;
    if model.length_counts && instance.moving {
        return 0.0;
    }
    let places = if model.length_counts { instance.len() + 2 } else { 0 };
    let pairs = (0..places).flat_map(|a| (0..places).map(move |b| (a, b)));
    let legs = pairs.filter(|(a, b)| a != b).map(|(a, b)| instance.distance_m(a, b));
    let mut grain = 0_u64;
    for cost in model.gains.iter().copied().chain(legs) {
        if cost.fract() != 0.0 || !(0.0..1e9).contains(&cost) {
            return 0.0;
        }
        let (mut a, mut b) = (grain, cost as u64);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        grain = a;
    }
    grain as f64
}
