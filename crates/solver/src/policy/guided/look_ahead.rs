//! Look-ahead: before each action, what the best few would lead to.

use super::Guide;
use super::guide::best;
use crate::framework::Episode;
use crate::policy::QError;

impl<'a> Guide<'a> {
    /// One episode in which the `width` actions of the highest values are each completed greedily, and the
    /// one with the best end is taken. Every completed episode is returned.
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn look_ahead(&self, width: usize) -> Result<Vec<Episode<'a>>, QError> {
        let mut episode = self.begin();
        let mut all = Vec::new();
        while !episode.is_over() {
            let values = self.values(&[&episode])?.swap_remove(0);
            let actions = top(values, width);
            let mut ends = Vec::with_capacity(width);
            for &action in &actions {
                let mut end = episode.clone();
                end.act(action);
                ends.push(end);
            }
            self.greedy(&mut ends, 1)?;
            let earned: Vec<f32> = ends.iter().map(|end| end.earned() as f32).collect();
            all.append(&mut ends);
            let Some(winner) = best(&earned) else { break };
            episode.act(actions[winner]);
        }
        if all.is_empty() {
            all.push(episode);
        }
        Ok(all)
    }
}

/// The indices of the highest values, the highest first.
fn top(mut values: Vec<f32>, count: usize) -> Vec<usize> {
    let mut top = Vec::with_capacity(count);
    while top.len() < count.min(values.len()) {
        let Some(next) = best(&values) else { break };
        values[next] = f32::NEG_INFINITY;
        top.push(next);
    }
    top
}
