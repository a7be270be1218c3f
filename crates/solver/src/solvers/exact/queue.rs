//! Labels that wait to be expanded, nearly best first.
//!
//! Bounds between the root's and the incumbent's cost are told apart in so many steps only. Within a step the last comes
//! first: it is at hand, and mostly the longest.

use super::label::Entry;

/// Steps of the bounds.
const STEPS: usize = 256;

/// The labels that wait.
#[derive(Debug)]
pub struct Queue {
    /// By step of the bound.
    waiting: Vec<Vec<Entry>>,
    /// No step before this one has any.
    first: usize,
    least: f64,
    /// Steps for each unit of the cost.
    per_cost: f64,
}

impl Queue {
    /// An empty queue for bounds from `least` up to `most`, which may be infinite.
    pub fn new(least: f64, most: f64) -> Self {
        let span = if most.is_finite() { most - least } else { least.abs() + 1.0 };
        let per_cost = if span > 0.0 { STEPS as f64 / span } else { 0.0 };
        Self { waiting: vec![Vec::new(); STEPS], first: STEPS, least, per_cost }
    }

    /// Adds a label.
    #[inline]
    pub fn push(&mut self, entry: Entry) {
        let step = (((entry.bound - self.least) * self.per_cost) as usize).min(STEPS - 1);
        self.first = self.first.min(step);
        self.waiting[step].push(entry);
    }

    /// Takes one of the best.
    #[inline]
    pub fn pop(&mut self) -> Option<Entry> {
        while let Some(waiting) = self.waiting.get_mut(self.first) {
            if let Some(entry) = waiting.pop() {
                return Some(entry);
            }
            self.first += 1;
        }
        None
    }

    /// The least bound of those that wait, infinite if none does.
    pub fn bound(&self) -> f64 {
        let waiting = self.waiting[self.first.min(STEPS - 1)..].iter().find(|w| !w.is_empty());
        waiting.map_or(f64::INFINITY, |waiting| {
            waiting.iter().map(|entry| entry.bound).fold(f64::INFINITY, f64::min)
        })
    }

    /// Takes all, the best first.
    pub fn drain(&mut self) -> Vec<Entry> {
        let mut all: Vec<Entry> = self.waiting.iter_mut().flat_map(|w| w.drain(..)).collect();
        all.sort_unstable_by(Entry::compare);
        self.first = STEPS;
        all
    }
}
