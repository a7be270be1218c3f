//! [`Encoding`]: one state as a Q-function sees it, compact enough to be remembered by the thousand.

use std::sync::Arc;

use super::{Batch, FEATURES};

/// Travel times between places over the scale of the instance; shared by all states of an episode where
/// nothing moves.
#[derive(Debug, PartialEq)]
pub struct Edges {
    /// Number of places.
    pub size: usize,
    /// `[size, size]`.
    pub values: Vec<f32>,
}

/// One state.
#[derive(Clone, Debug)]
pub struct Encoding {
    /// By row, the candidate; the stops so far and the legal actions, rising.
    pub candidates: Vec<u32>,
    /// By row, the index of its action; `None` for a stop.
    pub actions: Vec<Option<u32>>,
    /// `[rows, F]`.
    pub nodes: Vec<f32>,
    /// By row, its place in `edges`.
    pub places: Vec<u32>,
    /// Travel times.
    pub edges: Arc<Edges>,
}

impl Encoding {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.candidates.len()
    }
}

impl Batch {
    /// The tensors of some states, padded to the rows of the largest.
    pub fn pack<'a>(encodings: impl IntoIterator<Item = &'a Encoding> + Clone) -> Self {
        let rows = encodings.clone().into_iter().map(Encoding::rows).max().unwrap_or(0);
        let states = encodings.clone().into_iter().count();
        let mut batch = Self {
            states,
            rows,
            nodes: vec![0.0; states * rows * FEATURES],
            edges: vec![0.0; states * rows * rows],
            mask: vec![0.0; states * rows],
        };
        for (state, encoding) in encodings.into_iter().enumerate() {
            let used = encoding.rows();
            let nodes = state * rows * FEATURES;
            batch.nodes[nodes..nodes + used * FEATURES].copy_from_slice(&encoding.nodes);
            batch.mask[state * rows..state * rows + used].fill(1.0);
            let size = encoding.edges.size;
            for (i, &from) in encoding.places.iter().enumerate() {
                let into = (state * rows + i) * rows;
                let row = &encoding.edges.values[from as usize * size..][..size];
                for (edge, &to) in batch.edges[into..].iter_mut().zip(&encoding.places) {
                    *edge = row[to as usize];
                }
            }
        }
        batch
    }
}
