//! What a relaxed path remembers: at each candidate, which of its neighbours it has visited.
//!
//! The ng-path relaxation (R. Baldacci, A. Mingozzi, R. Roberti, "New route relaxation and pricing
//! strategies for the vehicle routing problem", 2011): a path may come back to a candidate once it has
//! passed one that does not remember it.

use super::network::Network;

/// Neighbours that a candidate remembers at most.
const MOST: usize = 12;

/// For each candidate the neighbours that it remembers; a state is a candidate with a subset of them.
#[derive(Clone, Debug)]
pub struct Memory {
    /// By candidate.
    pub of: Vec<Vec<u32>>,
}

impl Memory {
    /// Each candidate remembers the `size` nearest that have an arc to it.
    pub fn nearest(network: &Network, distance: impl Fn(usize, usize) -> f64, size: usize) -> Self {
        let n = network.first.len() - 2;
        let mut of = vec![Vec::new(); n];
        for from in 0..n {
            for arc in &network.arcs[network.leaving(from)] {
                of[arc.to as usize].push(from as u32);
            }
        }
        let mut keyed: Vec<(f64, u32)> = Vec::new();
        for (i, near) in of.iter_mut().enumerate() {
            keyed.clear();
            keyed.extend(near.iter().map(|&other| (distance(other as usize, i), other)));
            if size < keyed.len() {
                let nearer =
                    |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
                keyed.select_nth_unstable_by(size, nearer);
                keyed.truncate(size);
            }
            near.clear();
            near.extend(keyed.iter().map(|&(_, other)| other));
            near.sort_unstable();
        }
        Self { of }
    }

    /// Makes the candidates between two visits of `back` remember it, if they remember fewer than `most`.
    pub fn learn(&mut self, back: u32, between: &[u32], most: usize) {
        for &candidate in between {
            let near = &mut self.of[candidate as usize];
            if near.len() < most.min(MOST)
                && let Err(place) = near.binary_search(&back)
            {
                near.insert(place, back);
            }
        }
    }

    /// The subset of what `candidate` remembers for which `visited` holds, as a mask.
    #[inline]
    pub fn mask(&self, candidate: u32, visited: impl Fn(u32) -> bool) -> usize {
        let near = self.of[candidate as usize].iter().enumerate();
        near.map(|(bit, &other)| usize::from(visited(other)) << bit).sum()
    }
}
