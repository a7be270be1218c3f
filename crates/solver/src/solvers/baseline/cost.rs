//! One number for a tour that may lack something: what the annealing compares.

use crate::instance::Instance;
use crate::local_search::effort;
use crate::scenario::Objective;
use crate::solvers::partial::{Partial, gain};

/// A missing cover begins at so many scales.
const FIRST_WEIGHT: f64 = 3.0;
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
    first: f64,
}

impl Cost {
    /// Scales taken from the instance and a first tour.
    pub fn new(instance: &Instance<'_>, first: &Partial) -> Self {
        let stops = first.tour.len() as f64 + 1.0;
        let spent = effort(instance, first.tour.finished());
        let (per_effort, scale) = if instance.scenario.objective == Objective::MinDistance {
            (1.0, (spent / stops).max(mean_reach(instance) * 0.1))
        } else {
            let count = instance.len().max(1) as f64;
            let total: f64 = (0..instance.len() as u32).map(|c| gain(instance, c)).sum();
            let mean = if total > 0.0 { total / count } else { 1.0 };
            (if spent > 0.0 { EFFORT_SHARE * mean * stops / spent } else { 0.0 }, mean)
        };
        let scale = scale.max(1e-9);
        let weight = vec![FIRST_WEIGHT * scale; instance.demands.demands.len()];
        Self { per_effort, scale, weight, first: FIRST_WEIGHT * scale }
    }

    /// The cost of a tour.
    pub fn of(&self, instance: &Instance<'_>, partial: &Partial) -> f64 {
        let gains: f64 = match instance.scenario.objective {
            Objective::MinDistance => 0.0,
            Objective::MaxReward => partial.tour.reward(instance),
            Objective::MaxCount => partial.tour.len() as f64,
        };
        self.per_effort * effort(instance, partial.tour.finished()) - gains
            + partial.penalty(instance, &self.weight)
    }

    /// What serving a candidate is worth beside its effort.
    pub fn worth(&self, instance: &Instance<'_>, partial: &Partial, candidate: u32) -> f64 {
        gain(instance, candidate) + partial.relief(instance, candidate, &self.weight)
    }

    /// Demands that the tour lacks weigh more from now on, the others slowly less.
    pub fn adapt(&mut self, instance: &Instance<'_>, partial: &Partial) {
        for d in 0..self.weight.len() {
            let factor = if partial.lacks(instance, d) > 0 { 1.02 } else { 0.999 };
            self.weight[d] = (self.weight[d] * factor).clamp(self.first, LAST_WEIGHT * self.first);
        }
    }
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
