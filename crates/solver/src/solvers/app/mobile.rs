//! The quasi-polynomial approximation of the largest number of moving sensors within a time span (paper,
//! section "Mobile Network Charging Path Optimization Problem", after L. Chen et al., "Charge me if you
//! can", 2016; the recursion is that of C. Chekuri and M. Pal, "A recursive greedy algorithm for walks in
//! directed graphs", 2005).
//!
//! A path from one vertex to another within so many levels is split at every vertex between, whose step
//! splits the time as well: first the sub-path to it, then, with what that has charged no longer counting,
//! the sub-path from it on. The best of all splits is kept. At level 0 there is the edge alone.
//!
//! Deviations:
//! 1. A split at a vertex that cannot be reached, or left, on a straight edge is not tried: in a metric there
//!    is no sub-path either. And a path of as many stops as its level allows ends the search for a better one.
//! 2. Sub-paths do not come to a sensor a second time at another step.
//! 3. The tour is driven without waiting for the steps, so that every sensor is met no later than planned. A
//!    plan charges to the whole level: with an epsilon above 0 there may be no time left for the last stops.

use super::time_expanded::{TimeExpanded, Vertex};
use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::paper::{Attempt, PaperOptions, Unfinished, fitted};

pub(super) fn app(
    instance: &Instance<'_>,
    options: &PaperOptions,
    budget: &mut Budget<'_>,
) -> Attempt {
    let Some(graph) = TimeExpanded::new(instance, options) else {
        return Attempt::ended_by(Unfinished::Memory);
    };
    let charged = vec![false; instance.len()];
    let mut recursion = Recursion { graph: &graph, charged, budget };
    let path = recursion.path(&graph.start, &graph.end, options.app_level);
    if recursion.budget.is_spent() {
        return Attempt::ended_by(Unfinished::Budget);
    }
    Attempt::finished(fitted(instance, &path.unwrap_or_default()))
}

struct Recursion<'a, 'b, 'c> {
    graph: &'a TimeExpanded<'a, 'a>,
    /// By candidate, whether it no longer counts.
    charged: Vec<bool>,
    budget: &'b mut Budget<'c>,
}

impl Recursion<'_, '_, '_> {
    /// The sensors charged between two vertices, in order; `None` where there is no path. Once the budget is
    /// spent it means nothing.
    fn path(&mut self, from: &Vertex, to: &Vertex, level: u32) -> Option<Vec<u32>> {
        let graph = self.graph;
        let mut best = graph.has_edge(from, to).then(Vec::new);
        if level == 0 {
            return best;
        }
        let most = (1 << level) - 1;
        let first = graph.vertices.partition_point(|via| via.arrive_s < from.depart_s);
        for via in graph.vertices[first..].iter().take_while(|via| via.depart_s <= to.arrive_s) {
            if self.charged[via.node as usize] || !self.is_between(from, via, to) {
                continue;
            }
            if !self.budget.spend() {
                return best;
            }
            let split = self.split(from, via, to, level - 1);
            if split.as_ref().is_some_and(|s| best.as_ref().is_none_or(|b| s.len() > b.len())) {
                best = split;
            }
            if best.as_ref().is_some_and(|path| path.len() >= most) {
                break;
            }
        }
        best
    }

    /// The two sub-paths that meet at a vertex.
    fn split(&mut self, from: &Vertex, via: &Vertex, to: &Vertex, level: u32) -> Option<Vec<u32>> {
        self.charged[via.node as usize] = true;
        let whole = self.path(from, via, level).and_then(|mut path| {
            path.push(via.node);
            path.iter().for_each(|&node| self.charged[node as usize] = true);
            let rest = self.path(via, to, level);
            path.iter().for_each(|&node| self.charged[node as usize] = false);
            path.extend(rest?);
            Some(path)
        });
        self.charged[via.node as usize] = false;
        whole
    }

    fn is_between(&self, from: &Vertex, via: &Vertex, to: &Vertex) -> bool {
        let graph = self.graph;
        !graph.is_metric() || graph.has_edge(from, via) && graph.has_edge(via, to)
    }
}
