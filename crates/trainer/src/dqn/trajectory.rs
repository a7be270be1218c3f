//! [`Trajectory`]: an episode as it was played, and the samples that it leaves.

use std::sync::Arc;

use voltour_solver::policy::Encoding;

use super::Sample;

/// The states of an episode with the actions taken in them and their rewards.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    steps: Vec<(Arc<Encoding>, u32, f32)>,
}

impl Trajectory {
    /// Adds a step.
    pub fn push(&mut self, state: Arc<Encoding>, action: u32, reward: f32) {
        self.steps.push((state, action, reward));
    }

    /// Adds to the last reward.
    pub fn add(&mut self, bonus: f32) {
        if let Some((.., reward)) = self.steps.last_mut() {
            *reward += bonus;
        }
    }

    /// The number of steps.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing was done yet.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The sum of the rewards.
    pub fn total(&self) -> f32 {
        self.steps.iter().map(|(_, _, reward)| reward).sum()
    }

    /// One sample a step: the rewards of the next `horizon` steps, or of all (the Monte-Carlo return).
    pub fn samples(&self, horizon: Option<usize>) -> impl Iterator<Item = Sample> {
        (0..self.steps.len()).map(move |t| {
            let end = horizon.map_or(self.steps.len(), |n| self.steps.len().min(t + n.max(1)));
            let rewards = self.steps[t..end].iter().map(|(_, _, reward)| reward).sum();
            let (state, action, _) = &self.steps[t];
            let bootstrap = self.steps.get(end).map(|(state, _, _)| Arc::clone(state));
            Sample { state: Arc::clone(state), labels: vec![(*action, rewards)], bootstrap }
        })
    }
}
