//! Minimum spanning tree (paper, section "Fully Charging Reward Maximization Problem" of the comparison).
//!
//! The paper only names the algorithm. Here: Prim's tree grows from the service station (R. Prim, "Shortest
//! connection networks", 1957); its tour is the walk around it with short cuts.
//!
//! Deviations:
//! 1. A sensor joins only if the tour of the tree with it keeps every limit, first of all the capacity; one
//!    that does not is left out for good.
//! 2. Rewards play no part in who joins, as the name says; among tours of one tree there is no choice.

use super::Budget;
use super::paper::{Attempt, Unfinished};
use super::tree::Tree;
use crate::instance::Instance;
use crate::tour::simulate;

/// The tour of the minimum spanning tree that the charger can afford.
pub(super) fn mst(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Attempt {
    let mut tree = Tree::new(instance.len());
    let mut roots: Vec<u32> = Vec::new();
    let mut order = Vec::new();
    // For each candidate that is not in the tree, the nearest place that is: the start is no candidate.
    let mut near: Vec<(u32, Option<u32>, f64)> = (0..instance.len() as u32)
        .map(|to| (to, None, instance.distance_m(instance.start(), to as usize)))
        .collect();
    while !near.is_empty() {
        if budget.is_spent() {
            return Attempt { order, unfinished: Some(Unfinished::Budget) };
        }
        let closer = |a: usize, b: usize| if near[b].2 < near[a].2 { b } else { a };
        let next = (0..near.len()).fold(0, closer);
        let (joins, parent, _) = near.remove(next);
        match parent {
            Some(parent) => tree.hang(parent, joins),
            None => roots.push(joins),
        }
        let tour = tree.preorder(&roots);
        if simulate(instance, &tour).1 {
            order = tour;
            for (to, parent, leg_m) in &mut near {
                let from_here_m = instance.distance_m(joins as usize, *to as usize);
                if from_here_m < *leg_m {
                    (*parent, *leg_m) = (Some(joins), from_here_m);
                }
            }
        } else if let Some(parent) = parent {
            tree.drop_last(parent);
        } else {
            roots.pop();
        }
        budget.spend();
    }
    Attempt::finished(order)
}
