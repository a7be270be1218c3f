//! Capacitated minimum spanning tree (paper, section "Fully Charging Reward Maximization Problem" of the
//! comparison) by L. Esau and K. Williams, "On teleprocessing system design", 1966.
//!
//! The paper only names the algorithm. Here: every sensor begins as a branch of its own at the service
//! station; the two branches are joined whose joint saves most, as long as a charger can still serve the
//! joint branch.
//!
//! Deviations:
//! 1. A branch is within the capacity if its charges and the walk around it, station included, are: every edge
//!    there and back.
//! 2. One tour is asked for: that of the branch with the largest reward, the shorter among equals.
//! 3. Deadlines and other limits are no part of the tree: a stop for which they leave no time is passed by.

use super::Budget;
use super::paper::{Attempt, Unfinished, fitted};
use super::tree::Tree;
use crate::instance::Instance;
use crate::tour::{Tour, Value};

/// The tour of the best branch of the capacitated minimum spanning tree.
pub(super) fn cmst(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Attempt {
    let mut branches = Branches::new(instance);
    let mut unfinished = None;
    loop {
        if budget.is_spent() {
            unfinished = Some(Unfinished::Budget);
            break;
        }
        let Some(joint) = branches.best_joint() else { break };
        branches.join(joint);
        budget.spend();
    }
    let mut best = (Vec::new(), Value::of(instance, &Tour::new(instance, &[])));
    for branch in branches.all.iter().flatten() {
        let order = fitted(instance, &branches.around(branch));
        let tour = Tour::new(instance, &order);
        let value = Value::of(instance, &tour);
        if tour.is_legal() && value.beats(&best.1) {
            best = (order, value);
        }
    }
    Attempt { order: best.0, unfinished }
}

/// A branch at the service station.
#[derive(Clone, Debug)]
struct Branch {
    members: Vec<u32>,
    /// Its member nearest to the station, by which it hangs there.
    gate: u32,
    gate_m: f64,
    /// Length of its edges, without that to the station.
    edges_m: f64,
    charge_j: f64,
}

/// An edge between two branches in place of the first one's edge to the station.
#[derive(Clone, Copy, Debug)]
struct Joint {
    from: u32,
    to: u32,
    leg_m: f64,
    saved_m: f64,
}

struct Branches<'a, 'b> {
    instance: &'a Instance<'b>,
    all: Vec<Option<Branch>>,
    /// By candidate, its branch.
    of: Vec<usize>,
    edges: Vec<Vec<u32>>,
}

impl<'a, 'b> Branches<'a, 'b> {
    fn new(instance: &'a Instance<'b>) -> Self {
        let branch = |c: u32| Branch {
            members: vec![c],
            gate: c,
            gate_m: instance.distance_m(instance.start(), c as usize),
            edges_m: 0.0,
            charge_j: instance.candidates[c as usize].charge_j(0.0),
        };
        Self {
            instance,
            all: (0..instance.len() as u32).map(|c| Some(branch(c))).collect(),
            of: (0..instance.len()).collect(),
            edges: vec![Vec::new(); instance.len()],
        }
    }

    /// The joint that saves most; `None` where none saves anything within the capacity.
    fn best_joint(&self) -> Option<Joint> {
        let mut best: Option<Joint> = None;
        for branch in self.all.iter().flatten() {
            for &from in &branch.members {
                for to in 0..self.instance.len() as u32 {
                    let leg_m = self.instance.distance_m(from as usize, to as usize);
                    let saved_m = branch.gate_m - leg_m;
                    let more = best.map_or(0.0, |best| best.saved_m);
                    if saved_m > more && self.fits(branch, to, leg_m) {
                        best = Some(Joint { from, to, leg_m, saved_m });
                    }
                }
            }
        }
        best
    }

    /// Whether a branch may be hung on `to`.
    fn fits(&self, branch: &Branch, to: u32, leg_m: f64) -> bool {
        let Some(other) = &self.all[self.of[to as usize]] else { return false };
        let walk_m = 2.0 * (branch.edges_m + leg_m + other.edges_m + other.gate_m);
        let travel_j = self.instance.scenario.charger.travel_jpm * walk_m;
        other.gate != branch.gate
            && branch.charge_j + other.charge_j + travel_j <= self.instance.capacity_j
    }

    fn join(&mut self, joint: Joint) {
        let [from, to] = [joint.from, joint.to].map(|c| self.of[c as usize]);
        let (Some(branch), Some(other)) = (self.all[from].take(), self.all[to].as_mut()) else {
            return;
        };
        branch.members.iter().for_each(|&member| self.of[member as usize] = to);
        other.edges_m += branch.edges_m + joint.leg_m;
        other.charge_j += branch.charge_j;
        other.members.extend(branch.members);
        self.edges[joint.from as usize].push(joint.to);
        self.edges[joint.to as usize].push(joint.from);
    }

    /// The stops of a branch, around the tree from its gate, nearer children first.
    fn around(&self, branch: &Branch) -> Vec<u32> {
        let mut tree = Tree::new(self.instance.len());
        let mut ahead = vec![(branch.gate, None)];
        while let Some((here, parent)) = ahead.pop() {
            let below = self.edges[here as usize].iter().filter(|&&next| Some(next) != parent);
            let mut below: Vec<u32> = below.copied().collect();
            let leg_m = |next: u32| self.instance.distance_m(here as usize, next as usize);
            below.sort_by(|&a, &b| leg_m(a).total_cmp(&leg_m(b)));
            for next in below {
                tree.hang(here, next);
                ahead.push((next, Some(here)));
            }
        }
        tree.preorder(&[branch.gate])
    }
}
