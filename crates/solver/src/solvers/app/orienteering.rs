//! Point-to-point orienteering from min-excess paths (N. Bansal, A. Blum, S. Chawla, A. Meyerson,
//! "Approximation algorithms for deadline-TSP and vehicle routing with time-windows", 2004).
//!
//! The best path falls into three parts of a third of its reward each. One of them has at most a third of its
//! excess, the length beyond that of the straight edges between the parts' ends: an approximate
//! min-excess path between its ends, reached and left on straight edges, is within the bound. So all pairs of ends
//! are tried, and for each the min-excess paths of every reward.

use super::excess::Excess;
use crate::solvers::Budget;
use crate::solvers::paper::Unfinished;

/// A complete graph with a metric. The last two places are the start and the end of the path.
pub struct Graph {
    /// Row to column.
    pub lengths: Vec<f64>,
    /// Number of places.
    pub size: usize,
    /// By place; 0 at start and end.
    pub rewards: Vec<u64>,
    /// Length of a path at most.
    pub bound: f64,
}

impl Graph {
    /// The length of an edge.
    #[inline]
    pub fn length(&self, from: usize, to: usize) -> f64 {
        self.lengths[from * self.size + to]
    }

    /// Where a path begins.
    pub fn start(&self) -> usize {
        self.size - 2
    }

    /// Where it ends.
    pub fn end(&self) -> usize {
        self.size - 1
    }
}

/// The sites of the path with the largest reward found, in order; empty where none is within the bound.
pub fn orienteering(
    graph: &Graph,
    memory_bytes: usize,
    budget: &mut Budget<'_>,
) -> Result<Vec<usize>, Unfinished> {
    let mut best: (u64, f64, Vec<usize>) = (0, f64::INFINITY, Vec::new());
    for from in (0..graph.size).filter(|&from| from != graph.end()) {
        let reached = graph.length(graph.start(), from);
        let excess = Excess::from(graph, from, graph.bound - reached, memory_bytes, budget)?;
        for to in (0..graph.size).filter(|&to| to != from && to != graph.start()) {
            let left = graph.length(to, graph.end());
            let room = graph.bound - reached - left;
            let found = excess.largest(to, room, best.0, budget)?;
            if let Some((reward, length, path)) = found {
                let length = reached + length + left;
                if reward > best.0 || reward == best.0 && length < best.1 {
                    best = (reward, length, path);
                }
            }
        }
    }
    best.2.retain(|&place| place < graph.start());
    Ok(best.2)
}
