//! Min-excess paths from one place (A. Blum et al., "Approximation algorithms for orienteering and
//! discounted-reward TSP", 2003): for every end and every reward a short path.
//!
//! Places are sorted by their distance from the first. A path of little excess goes mostly outward, and where
//! it does not, it wiggles within a range of distances; ranges do not overlap. A dynamic programme over
//! the sorted places puts together the wiggles, each a short path of a given reward (`k_path`).
//!
//! Deviations:
//! 1. A wiggle that is not the last one goes from the nearest place of its range to the farthest, rather than
//!    between any two: a cubic number of sub-problems in place of one to the fourth.
//! 2. Of each place's paths those are kept that no other beats in reward and length: the table of the
//!    programme without its empty and its useless entries.

use super::k_path::{Wiggle, wiggles};
use super::orienteering::Graph;
use crate::solvers::Budget;
use crate::solvers::paper::Unfinished;

/// No path before this one.
const NONE: u32 = u32::MAX;

/// The paths from one place.
pub struct Excess<'a> {
    graph: &'a Graph,
    /// Places by distance from the first, which is the first of them; without start and end, if they are not it.
    sorted: Vec<usize>,
    paths: Vec<Path>,
    /// Of each sorted place, its paths by rising reward and length.
    kept: Vec<Vec<u32>>,
}

/// A path to a place: what it collects with both ends, its length, and of what it is made.
struct Path {
    reward: u64,
    length: f64,
    before: u32,
    /// The last wiggle without its first place.
    last: Vec<usize>,
}

impl<'a> Excess<'a> {
    /// The paths from `first` that are, with the straight edge to the end, no longer than `room`.
    pub fn from(
        graph: &'a Graph,
        first: usize,
        room: f64,
        memory_bytes: usize,
        budget: &mut Budget<'_>,
    ) -> Result<Self, Unfinished> {
        let mut sorted: Vec<usize> = (0..graph.start()).filter(|&place| place != first).collect();
        sorted.sort_by(|&a, &b| graph.length(first, a).total_cmp(&graph.length(first, b)));
        sorted.insert(0, first);
        let kept = vec![Vec::new(); sorted.len()];
        let mut excess = Self { graph, sorted, paths: Vec::new(), kept };
        let origin =
            Path { reward: graph.rewards[first], length: 0.0, before: NONE, last: vec![first] };
        excess.keep(0, origin);
        let mut bytes = 0;
        for near in 0..excess.sorted.len() {
            for far in near + 1..excess.sorted.len() {
                if budget.is_spent() {
                    return Err(Unfinished::Budget);
                }
                bytes += excess.extend(near, far, room);
                if bytes > memory_bytes {
                    return Err(Unfinished::Memory);
                }
                budget.spend();
            }
        }
        Ok(excess)
    }

    /// Extends the paths to one place by the wiggles to a farther one; bytes of what is new.
    fn extend(&mut self, near: usize, far: usize, room: f64) -> usize {
        let Some(&shortest) = self.kept[near].first() else { return 0 };
        let between = &self.sorted[near + 1..far];
        let (from, to) = (self.sorted[near], self.sorted[far]);
        // However a path goes on, it comes to the end.
        let room = room - self.graph.length(to, self.graph.end());
        let left = room - self.paths[shortest as usize].length;
        let mut bytes = 0;
        for wiggle in wiggles(self.graph, from, to, between, left) {
            for before in self.kept[near].clone() {
                let path = self.longer(before, &wiggle, to);
                if path.length <= room {
                    bytes += 2 * size_of::<Path>() + path.last.len() * size_of::<usize>();
                    self.keep(far, path);
                }
            }
        }
        bytes
    }

    fn longer(&self, before: u32, wiggle: &Wiggle, to: usize) -> Path {
        let old = &self.paths[before as usize];
        Path {
            reward: old.reward + wiggle.reward + self.graph.rewards[to],
            length: old.length + wiggle.length,
            before,
            last: wiggle.places[1..].to_vec(),
        }
    }

    /// Keeps a path unless another collects as much in as little.
    fn keep(&mut self, place: usize, new: Path) {
        let paths = &self.paths;
        let beats = |a: &Path, b: &Path| a.reward >= b.reward && a.length <= b.length;
        let kept = &mut self.kept[place];
        if kept.iter().any(|&old| beats(&paths[old as usize], &new)) {
            return;
        }
        kept.retain(|&old| !beats(&new, &paths[old as usize]));
        let at = kept.partition_point(|&old| paths[old as usize].reward < new.reward);
        kept.insert(at, self.paths.len() as u32);
        self.paths.push(new);
    }

    /// The path to a place that collects most within a length, if that is no less than `least`; its last
    /// wiggle may go farther than its end.
    pub fn largest(
        &self,
        to: usize,
        room: f64,
        least: u64,
        budget: &mut Budget<'_>,
    ) -> Result<Option<(u64, f64, Vec<usize>)>, Unfinished> {
        let mut best: Option<(u64, f64, u32, Vec<usize>)> = None;
        let limit = self.sorted.iter().position(|&place| place == to).unwrap_or(self.sorted.len());
        for near in 0..limit {
            let Some(&shortest) = self.kept[near].first() else { continue };
            if budget.is_spent() {
                return Err(Unfinished::Budget);
            }
            budget.spend();
            let left = room - self.paths[shortest as usize].length;
            let ahead: Vec<usize> =
                self.sorted[near + 1..].iter().copied().filter(|&place| place != to).collect();
            for wiggle in wiggles(self.graph, self.sorted[near], to, &ahead, left) {
                // The longest path that leaves room for the wiggle collects most.
                let fits = |&&path: &&u32| self.paths[path as usize].length + wiggle.length <= room;
                let Some(&before) = self.kept[near].iter().rev().find(fits) else { continue };
                let old = &self.paths[before as usize];
                let reward = old.reward + wiggle.reward + self.graph.rewards[to];
                let length = old.length + wiggle.length;
                let better = match &best {
                    Some((most, shortest, ..)) => {
                        reward > *most || reward == *most && length < *shortest
                    }
                    None => reward >= least,
                };
                if better {
                    best = Some((reward, length, before, wiggle.places[1..].to_vec()));
                }
            }
        }
        Ok(best
            .map(|(reward, length, before, last)| (reward, length, self.trace_back(before, last))))
    }

    fn trace_back(&self, mut before: u32, mut after: Vec<usize>) -> Vec<usize> {
        while before != NONE {
            let path = &self.paths[before as usize];
            after.splice(0..0, path.last.iter().copied());
            before = path.before;
        }
        after
    }
}
