//! The greedy policy: the action of the highest value, until the episode is over.

use voltour_solver::policy::Encoding;

use crate::network::Network;

use super::Play;

/// Values within this are equal, and the smaller row wins.
const EQUAL: f32 = 1e-5;

/// The row of the legal action of the highest value; `None` if there is none.
pub fn best(encoding: &Encoding, values: &[f32]) -> Option<usize> {
    let legal = || encoding.actions.iter().zip(values).map(|(action, q)| action.map(|_| *q));
    let most = legal().flatten().fold(f32::NEG_INFINITY, f32::max);
    legal().position(|q| q.is_some_and(|q| q >= most - EQUAL))
}

/// Completes an episode greedily and gives the sum of the rewards.
pub fn complete(network: &Network, play: &mut Play<'_>) -> f32 {
    let mut total = 0.0;
    while !play.episode.is_over() {
        let encoding = play.encode();
        let Some(row) = best(&encoding, &network.values_of(&encoding)) else { break };
        total += play.act(&encoding, row);
    }
    total
}
