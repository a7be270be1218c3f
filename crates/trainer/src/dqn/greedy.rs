//! The greedy policy: the action of the highest value, until the episode is over.

use crate::network::Network;

use super::{Episode, State};

/// Values within this are equal, and the smaller row wins.
const EQUAL: f32 = 1e-5;

/// The legal action of the highest value; `None` if there is none.
pub fn best(state: &State, values: &[f32]) -> Option<u32> {
    let better = |best: Option<u32>, action: u32| match best {
        Some(b) if values[action as usize] <= values[b as usize] + EQUAL => Some(b),
        _ => Some(action),
    };
    state.actions.iter().copied().fold(None, better)
}

/// Completes an episode greedily and gives the sum of the rewards.
pub fn complete<E: Episode>(network: &Network, episode: &mut E) -> f32 {
    let mut total = 0.0;
    while !episode.is_over() {
        let state = episode.state();
        let values = network.values_of(&state.nodes, &state.edges);
        let Some(action) = best(&state, &values) else { break };
        total += episode.act(action as usize);
    }
    total
}
