//! Roll-outs: what several actions of the same state are worth when the greedy policy goes on after them.

use std::sync::Arc;

use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use voltour_solver::policy::Encoding;

use crate::network::Network;

use super::random::index;
use super::{Options, Play, Sample, complete};

/// Tries out the best few actions of each episode's state and some others, each completed greedily. States with
/// fewer than two actions tell nothing and are left out.
pub fn rollouts(
    network: &Network,
    plays: &[Play<'_>],
    options: &Options,
    rng: &mut Pcg64Mcg,
) -> Vec<Sample> {
    let mut trials = Vec::new();
    let mut samples = Vec::new();
    for play in plays {
        let state = Arc::new(play.encode());
        let mut rows: Vec<usize> =
            (0..state.rows()).filter(|r| state.actions[*r].is_some()).collect();
        if rows.len() < 2 {
            continue;
        }
        let values = network.values_of(&state);
        rows.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
        let mut others = rows.split_off(options.rollout_best.min(rows.len()));
        for _ in 0..options.rollout_random.min(others.len()) {
            rows.push(others.swap_remove(index(rng, others.len())));
        }
        trials.extend(rows.into_iter().map(|row| (samples.len(), play, row, Arc::clone(&state))));
        samples.push(Sample { state, labels: Vec::new(), bootstrap: None });
    }
    let label = |(sample, play, row, state): &(usize, &Play<'_>, usize, Arc<Encoding>)| {
        let mut play = (*play).clone();
        let reward = play.act(state, *row);
        (*sample, (*row as u32, reward + complete(network, &mut play)))
    };
    let labels: Vec<(usize, (u32, f32))> = trials.par_iter().map(label).collect();
    labels.into_iter().for_each(|(sample, label)| samples[sample].labels.push(label));
    samples
}
