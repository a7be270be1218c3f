//! Look-ahead: before each action, what the best few would lead to.

use super::guide::best;
use super::{Guide, Kept};
use crate::framework::Episode;
use crate::policy::QError;

impl<'a> Guide<'a> {
    /// One episode in which the `width` actions of the highest values are each completed greedily, and the
    /// one with the best end is taken. Every complete tour goes to `kept`; the best end is returned.
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn look_ahead(&self, width: usize, kept: &mut Kept) -> Result<Episode<'a>, QError> {
        let mut episode = self.begin();
        let mut best_end: Option<Episode<'a>> = None;
        while !episode.is_over() {
            let values = self.values(&[&episode])?.swap_remove(0);
            let actions = top(values, width);
            let mut ends: Vec<Episode<'a>> = Vec::with_capacity(width);
            for &action in &actions {
                let mut end = episode.clone();
                end.act(action);
                ends.push(end);
            }
            self.greedy(&mut ends)?;
            ends.iter().for_each(|end| kept.finished(end));
            let earned: Vec<f32> = ends.iter().map(|end| end.earned() as f32).collect();
            let Some(winner) = best(&earned) else { break };
            episode.act(actions[winner]);
            let end = ends.swap_remove(winner);
            if best_end.as_ref().is_none_or(|best| end.earned() > best.earned()) {
                best_end = Some(end);
            }
        }
        Ok(best_end.unwrap_or(episode))
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
