//! Roll-outs: what several actions of the same state are worth when the greedy policy goes on after them.

use std::sync::Arc;

use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use crate::network::Network;

use super::random::index;
use super::{Episode, Options, Sample, complete};

/// Tries out the best few actions of each episode's state and some others, each completed greedily. States with
/// fewer than two actions tell nothing and are left out.
pub fn rollouts<E: Episode>(
    network: &Network,
    episodes: &[E],
    options: &Options,
    rng: &mut Pcg64Mcg,
) -> Vec<Sample> {
    let mut trials = Vec::new();
    let mut samples = Vec::new();
    for episode in episodes {
        let state = Arc::new(episode.state());
        if state.actions.len() < 2 {
            continue;
        }
        let values = network.values_of(&state.nodes, &state.edges);
        let mut actions = state.actions.clone();
        actions.sort_by(|a, b| values[*b as usize].total_cmp(&values[*a as usize]));
        let mut others = actions.split_off(options.rollout_best.min(actions.len()));
        for _ in 0..options.rollout_random.min(others.len()) {
            actions.push(others.swap_remove(index(rng, others.len())));
        }
        trials.extend(actions.into_iter().map(|action| (samples.len(), episode, action)));
        samples.push(Sample { state, labels: Vec::new(), bootstrap: None });
    }
    let play = |(sample, episode, action): &(usize, &E, u32)| {
        let mut episode = (*episode).clone();
        let reward = episode.act(*action as usize);
        (*sample, (*action, reward + complete(network, &mut episode)))
    };
    let labels: Vec<(usize, (u32, f32))> = trials.par_iter().map(play).collect();
    labels.into_iter().for_each(|(sample, label)| samples[sample].labels.push(label));
    samples
}
