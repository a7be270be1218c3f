//! [`State`]: what a Q-network sees of an episode, without padding.

use std::sync::Arc;

use voltour_solver::policy::{Batch, FEATURES};

/// What a Q-network sees of an episode. The travel times do not change within most episodes and are shared.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// `[N, F]`: the features of the candidates.
    pub nodes: Vec<f32>,
    /// `[N, N]`: travel times.
    pub edges: Arc<[f32]>,
    /// The rows that are legal actions, ascending.
    pub actions: Vec<u32>,
}

impl State {
    /// The number of candidates, N.
    pub fn rows(&self) -> usize {
        self.nodes.len() / FEATURES
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.nodes.iter().chain(&*self.edges).all(|v| v.is_finite())
    }

    /// States as one batch, padded to the largest.
    pub fn batch(states: &[&State]) -> Batch {
        let rows = states.iter().map(|s| s.rows()).max().unwrap_or(0);
        let count = states.len();
        let mut batch = Batch {
            states: count,
            rows,
            nodes: vec![0.0; count * rows * FEATURES],
            edges: vec![0.0; count * rows * rows],
            mask: vec![0.0; count * rows],
        };
        for (b, state) in states.iter().enumerate() {
            let n = state.rows();
            let start = b * rows * FEATURES;
            batch.nodes[start..start + state.nodes.len()].copy_from_slice(&state.nodes);
            batch.mask[b * rows..b * rows + n].fill(1.0);
            for (i, line) in state.edges.chunks_exact(n.max(1)).enumerate() {
                let start = (b * rows + i) * rows;
                batch.edges[start..start + n].copy_from_slice(line);
            }
        }
        batch
    }
}
