//! Roll-outs: one action after the other until the episode is over, many episodes side by side.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Guide;
use super::guide::best;
use crate::framework::Episode;
use crate::policy::QError;

impl<'a> Guide<'a> {
    /// Takes the best action in each state that leaves no demand impossible, until all episodes are over; and, before
    /// it values the next state, as many of the next best as make `at_once`, as far as they are actions still.
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn greedy(&self, episodes: &mut [Episode<'a>], at_once: usize) -> Result<(), QError> {
        self.roll_out(episodes, at_once, |_| 0.0)
    }

    /// The same with Gumbel noise on each value, so that actions are drawn with probability
    /// proportional to exp(q / temperature).
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn sample(
        &self,
        episodes: &mut [Episode<'a>],
        temperature: f64,
        rng: &mut Pcg64Mcg,
    ) -> Result<(), QError> {
        self.roll_out(episodes, 1, |_| {
            let uniform = rng.random_range(1e-12..1.0_f64);
            (-temperature * (-uniform.ln()).ln()) as f32
        })
    }

    fn roll_out(
        &self,
        episodes: &mut [Episode<'a>],
        at_once: usize,
        mut noise: impl FnMut(f32) -> f32,
    ) -> Result<(), QError> {
        loop {
            let mut live: Vec<&mut Episode<'a>> =
                episodes.iter_mut().filter(|episode| !episode.is_over()).collect();
            if live.is_empty() {
                return Ok(());
            }
            let shared: Vec<&Episode<'a>> = live.iter().map(|episode| &**episode).collect();
            let values = self.values(&shared)?;
            for (episode, mut values) in live.iter_mut().zip(values) {
                values.iter_mut().for_each(|value| *value += noise(*value));
                let next_best = next_best(episode, &values, at_once);
                step_safely(episode, values);
                step_on(episode, &next_best);
            }
        }
    }
}

/// Takes the best action that leaves no demand impossible; where each of them does, the best.
fn step_safely(episode: &mut Episode<'_>, mut values: Vec<f32>) {
    let Some(first) = best(&values) else { return };
    let mut action = Some(first);
    while let Some(index) = action.filter(|&index| values[index] > f32::NEG_INFINITY) {
        if act_safely(episode, index) {
            return;
        }
        values[index] = f32::NEG_INFINITY;
        action = best(&values);
    }
    episode.act(first);
}

/// The candidates of the best actions but the first, `at_once` with it.
fn next_best(episode: &Episode<'_>, values: &[f32], at_once: usize) -> Vec<u32> {
    if at_once < 2 {
        return Vec::new();
    }
    let mut left = values.to_vec();
    let mut ranked = Vec::new();
    for _ in 0..at_once.min(left.len()) {
        let Some(index) = best(&left) else { break };
        left[index] = f32::NEG_INFINITY;
        ranked.push(episode.actions()[index].candidate);
    }
    ranked.into_iter().skip(1).collect()
}

/// Takes the actions of these candidates that leave no demand impossible.
fn step_on(episode: &mut Episode<'_>, candidates: &[u32]) {
    for &candidate in candidates {
        let index = episode.actions().iter().position(|action| action.candidate == candidate);
        if let Some(index) = index {
            act_safely(episode, index);
        }
    }
}

/// Takes an action unless it leaves a demand impossible; whether it did.
fn act_safely(episode: &mut Episode<'_>, index: usize) -> bool {
    let mut next = episode.clone();
    next.act(index);
    let safe = !next.is_over() || next.succeeded();
    if safe {
        *episode = next;
    }
    safe
}
