//! One number for a tour that may lack something: what the annealing compares.

use crate::instance::{Demand, Instance};
use crate::local_search::effort;
use crate::scenario::Objective;
use crate::solvers::partial::{Partial, gain};
use crate::tour::Tour;

/// A missing cover begins at so many scales.
const FIRST_WEIGHT: f64 = 3.0;
/// A `required` request counts as so many covers.
const REQUIRED: f64 = 10.0;
/// And ends at so many times its first weight.
const LAST_WEIGHT: f64 = 1e4;
/// What the effort of a mean stop counts beside the gain of a mean candidate.
const EFFORT_SHARE: f64 = 0.5;

/// Cost = effort - gain + weighted misses, each in the unit of the objective.
pub struct Cost {
    /// Cost of one unit of effort.
    pub per_effort: f64,
    /// What a single change is expected to be worth: the temperature is a multiple of it.
    pub scale: f64,
    /// Weight of each demand's misses; adapted.
    pub weight: Vec<f64>,
    /// By demand, the least weight.
    first: Vec<f64>,
}

impl Cost {
    /// Scales taken from the instance and a first tour.
    pub fn new(instance: &Instance<'_>, first: &Partial) -> Self {
        let first_tour = &first.tour;
        let scale = if instance.scenario.objective == Objective::MinDistance {
            let leg = first_tour.finished().distance_m / (first_tour.len() as f64 + 1.0);
            leg.max(mean_reach(instance) * 0.1)
        } else {
            let total: f64 = (0..instance.len() as u32).map(|c| gain(instance, c)).sum();
            if total > 0.0 { total / instance.len() as f64 } else { 1.0 }
        };
        let scale = scale.max(1e-9);
        let first: Vec<f64> = instance.demands.demands.iter().map(|d| least(d) * scale).collect();
        let mut cost = Self { per_effort: 1.0, scale, weight: first.clone(), first };
        cost.price(instance, first_tour);
        cost
    }

    /// Sets the price of effort, whose meaning may have changed.
    pub fn price(&mut self, instance: &Instance<'_>, tour: &Tour) {
        let spent = effort(instance, tour.finished());
        if instance.scenario.objective != Objective::MinDistance {
            let stops = tour.len() as f64 + 1.0;
            self.per_effort =
                if spent > 0.0 { EFFORT_SHARE * self.scale * stops / spent } else { 0.0 };
        }
    }

    /// The cost of a tour.
    pub fn of(&self, instance: &Instance<'_>, partial: &Partial) -> f64 {
        let gains: f64 = match instance.scenario.objective {
            Objective::MinDistance => 0.0,
            Objective::MaxReward => partial.tour.reward(instance),
            Objective::MaxCount => partial.tour.len() as f64,
        };
        let spent = self.per_effort * effort(instance, partial.tour.finished());
        spent - gains + partial.penalty(&self.weight)
    }

    /// What serving a candidate is worth beside its effort.
    pub fn worth(&self, instance: &Instance<'_>, partial: &Partial, candidate: u32) -> f64 {
        gain(instance, candidate) + partial.relief(instance, candidate, &self.weight)
    }

    /// Whether that is more than nothing: every open demand has a weight.
    pub fn is_worth(&self, instance: &Instance<'_>, partial: &Partial, candidate: u32) -> bool {
        gain(instance, candidate) > 0.0 || partial.helps(instance, candidate)
    }

    /// Demands that the tour lacks weigh more from now on, the others slowly less.
    pub fn adapt(&mut self, partial: &Partial) {
        for d in 0..self.weight.len() {
            let factor = if partial.lacks(d) > 0 { 1.02 } else { 0.999 };
            let least = self.first[d];
            self.weight[d] = (self.weight[d] * factor).clamp(least, LAST_WEIGHT * least);
        }
    }
}

/// Least weight of a demand in scales: one for each covering set that asks it, and more for a
/// `required` request, which comes first where not everything can be had.
fn least(demand: &Demand) -> f64 {
    FIRST_WEIGHT * if demand.required { REQUIRED } else { f64::from(demand.sets) }
}

/// Mean distance from the start to a candidate, in metres.
fn mean_reach(instance: &Instance<'_>) -> f64 {
    let start = instance.scenario.charger.start_m;
    let reach = |c: usize| {
        if instance.moving {
            (instance.candidates[c].point - start).norm()
        } else {
            instance.distance_m(instance.start(), c)
        }
    };
    (0..instance.len()).map(reach).sum::<f64>() / instance.len().max(1) as f64
}
