//! [`State`]: a partial solution, with what is known of the demands.

use std::sync::Arc;

use super::{Action, Insert, Scales};
use crate::instance::Instance;
use crate::solvers::{Partial, gain};
use crate::tour::{Insertion, Tour};

/// A partial solution: the ordered list of stops so far.
#[derive(Clone, Debug)]
pub struct State<'a> {
    instance: &'a Instance<'a>,
    partial: Partial,
    /// Candidates that can be worth something.
    useful: Arc<[u32]>,
    scales: Scales,
    open_demands: usize,
}

impl<'a> State<'a> {
    /// The state that an episode begins with.
    pub fn new(instance: &'a Instance<'a>) -> Self {
        // Where leaving a stop out never breaks a limit, a stop that helps nothing is never needed.
        let helps = |c: u32| !instance.demands.of[c as usize].is_empty() || gain(instance, c) > 0.0;
        let all = 0..instance.len() as u32;
        let useful: Arc<[u32]> = all.filter(|&c| helps(c)).collect();
        Self {
            instance,
            partial: Partial::new(instance, &[]),
            scales: Scales::new(instance, &useful),
            useful,
            open_demands: instance.demands.demands.len(),
        }
    }

    /// What it is a state of.
    pub fn instance(&self) -> &'a Instance<'a> {
        self.instance
    }

    /// The stops so far.
    pub fn tour(&self) -> &Tour {
        &self.partial.tour
    }

    /// The units of the instance.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }

    /// Candidates that can be worth something, rising.
    pub fn useful(&self) -> &[u32] {
        &self.useful
    }

    /// Number of demands that are not met.
    pub fn open_demands(&self) -> usize {
        self.open_demands
    }

    /// How many members demand `d` still lacks.
    pub fn lacks(&self, d: usize) -> u32 {
        self.partial.lacks(d)
    }

    /// How many members all demands lack together.
    pub fn missing(&self) -> u32 {
        self.partial.missing()
    }

    /// Puts a candidate before the stop at `position`.
    pub fn insert(&mut self, candidate: u32, position: usize) {
        self.partial.insert(self.instance, position, candidate);
        let demands = 0..self.instance.demands.demands.len();
        self.open_demands = demands.filter(|&d| self.lacks(d) > 0).count();
    }

    /// The state after [`Self::insert`].
    #[must_use]
    pub fn after(&self, candidate: u32, position: usize) -> Self {
        let mut after = self.clone();
        after.insert(candidate, position);
        after
    }

    /// Whether inserting a candidate would serve a purpose now: to meet an open demand as long as there is
    /// one, then to gain something.
    pub fn helps(&self, candidate: u32) -> bool {
        if self.open_demands > 0 {
            let mut of = self.instance.demands.of[candidate as usize].iter();
            of.any(|&d| self.lacks(d as usize) > 0)
        } else {
            gain(self.instance, candidate) > 0.0
        }
    }

    /// The place that an insertion function gives a candidate; `None` if it has no legal one. The reward
    /// is yet to be filled in.
    pub fn place(&self, candidate: u32, insert: Insert) -> Option<Action> {
        if !self.tour().has_room(self.instance, candidate) {
            return None;
        }
        let stops = self.tour().len();
        let positions = match insert {
            Insert::Cheapest => 0..=stops,
            Insert::Append => stops..=stops,
        };
        let looked_at = positions.clone().count();
        let (mut best, mut legal): (Option<Insertion>, usize) = (None, 0);
        let mut second = f64::INFINITY;
        for position in positions {
            let Some(found) = self.tour().insertion(self.instance, position, candidate) else {
                continue;
            };
            legal += 1;
            match best {
                Some(best) if best.effort <= found.effort => second = second.min(found.effort),
                _ => {
                    second = best.map_or(second, |best| best.effort);
                    best = Some(found);
                }
            }
        }
        let legal_share = legal as f64 / looked_at as f64;
        best.map(|insertion| {
            let regret = second - insertion.effort;
            Action { candidate, insertion, legal_share, regret, reward: 0.0 }
        })
    }
}
