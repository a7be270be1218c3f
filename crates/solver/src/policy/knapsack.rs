//! What is left of the scarce resource, and how far it would go: the fractional knapsack of the actions.

use super::Feature;
use crate::framework::{Action, Episode, Scales};
use crate::scenario::Objective;
use crate::solvers::gain;

/// The knapsack of a state. Where the objective is the distance there is none, and all is 0.
pub struct Knapsack {
    /// Share of the scarce resource that is left.
    pub left_share: f64,
    /// Gain of the actions that would fit, the best ratio first, the last in part.
    pub gain: f64,
    /// What is left, in units of [`crate::instance::Effort`].
    left: f64,
    /// By rank of the ratio, the action's ratio and the effort of all better ones.
    ranks: Vec<(f64, f64)>,
    /// By candidate, its gain.
    gains: Vec<f64>,
}

impl Knapsack {
    pub fn new(episode: &Episode<'_>) -> Self {
        let state = episode.state();
        let instance = state.instance();
        let none =
            Self { left_share: 0.0, gain: 0.0, left: 0.0, ranks: Vec::new(), gains: Vec::new() };
        if instance.scenario.objective == Objective::MinDistance {
            return none;
        }
        let end = state.tour().finished();
        let left = |used: f64, limit: f64| {
            if limit.is_finite() { ((limit - used) / limit.max(1e-9)).max(0.0) } else { 1.0 }
        };
        let time = left(end.arrive_s, instance.timespan_s);
        let left_share = time.min(left(instance.energy_j(end), instance.capacity_j));
        let gains: Vec<f64> = (0..instance.len() as u32).map(|c| gain(instance, c)).collect();
        let ratio = |action: &Action| gains[action.candidate as usize] / effort(action);
        let mut sorted: Vec<&Action> = episode.actions().iter().collect();
        sorted.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
        let (mut ranks, mut before, mut total) = (Vec::new(), 0.0, 0.0);
        for action in sorted {
            ranks.push((ratio(action), before));
            let fits = ((left_share - before) / effort(action)).clamp(0.0, 1.0);
            total += fits * gains[action.candidate as usize];
            before += effort(action);
        }
        Self { left_share, gain: total, left: left_share, ranks, gains }
    }

    pub fn fill(&self, action: &Action, scales: &Scales, mut set: impl FnMut(Feature, f64)) {
        if self.ranks.is_empty() {
            return;
        }
        let gain = self.gains[action.candidate as usize];
        let ratio = gain / effort(action);
        let rank = self.ranks.partition_point(|&(better, _)| better > ratio);
        let before = self.ranks.get(rank).map_or(0.0, |&(_, before)| before);
        let share = effort(action) / self.left.max(1e-9);
        set(Feature::Share, share / (1.0 + share));
        let beside = ratio * scales.effort / scales.gain;
        set(Feature::Ratio, beside / (1.0 + beside));
        let before = before / self.left.max(1e-9);
        set(Feature::Before, before / (1.0 + before));
    }
}

/// The effort of an action; one that costs nothing costs next to nothing.
fn effort(action: &Action) -> f64 {
    action.insertion.effort.max(1e-9)
}
