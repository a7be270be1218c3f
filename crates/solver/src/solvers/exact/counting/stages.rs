//! Partial tours stop by stop: all of one length, then all that are one stop longer.
//!
//! Of two partial tours that served the same and stand at the same candidate, the earlier one can do all that
//! the other can. Those whose bound shows that they end too late are dropped, and where too many are left, all
//! but the best.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::{Prices, Tails};
use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::exact::bits::Bits;
use crate::solvers::exact::network::stand;
use crate::tour::Run;

/// How a search ended.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// Tours that keep the limits as the check does; the one that ends first comes first.
    Found(Vec<Vec<u32>>),
    /// There is no tour of so many stops.
    None,
    /// None was found, but not all were looked at.
    Cut,
}

/// Tours handed out at most.
const MOST_FOUND: usize = 64;

#[derive(Clone, Debug)]
struct Label<const W: usize> {
    served: Bits<W>,
    arrive_s: f64,
    /// What prices add to the end of the tour less the prizes taken.
    paid_s: f64,
    /// The tour ends then at the earliest.
    bound_s: f64,
    at: u32,
    parent: u32,
}

/// Labels of one number of stops.
#[derive(Debug)]
struct Layer<const W: usize> {
    labels: Vec<Label<W>>,
    index: HashMap<(Bits<W>, u32), u32, rustc_hash::FxBuildHasher>,
    width: usize,
    /// Labels with this bound or more have been given up.
    cut_s: f64,
}

/// A search for a tour of a given number of stops.
#[derive(Debug)]
pub struct Stages<'s> {
    pub instance: &'s Instance<'s>,
    pub tails: &'s Tails<'s>,
    pub prices: &'s Prices,
    /// Labels that are kept of each number of stops.
    pub width: usize,
}

impl Stages<'_> {
    /// Memory that each label kept takes, with its like in the next stage before that is thinned out, and
    /// with the trail of `stops` stages.
    pub const fn bytes<const W: usize>(stops: usize) -> usize {
        3 * size_of::<Label<W>>() + 4 * size_of::<(Bits<W>, u32, u32)>() + 8 * stops
    }

    /// Searches until a stage is empty, the last one is reached or the budget is spent.
    pub fn run<const W: usize>(&self, budget: &mut Budget<'_>) -> Outcome {
        let root = Label {
            served: Bits::<W>::EMPTY,
            arrive_s: 0.0,
            paid_s: self.prices.fixed_s(),
            bound_s: self.prices.bound_s,
            at: self.instance.start() as u32,
            parent: 0,
        };
        let mut trail: Vec<Vec<(u32, u32)>> = Vec::with_capacity(self.prices.stops);
        let (mut stage, mut cut) = (vec![root], false);
        for _stop in 0..self.prices.stops {
            let mut next = Layer::new(self.width);
            for (parent, label) in (0u32..).zip(&stage) {
                if !budget.spend() {
                    return Outcome::Cut;
                }
                self.extend(label, parent, &mut next);
            }
            next.thin();
            cut |= next.cut_s < f64::INFINITY;
            stage = next.labels;
            trail.push(stage.iter().map(|label| (label.parent, label.at)).collect());
        }
        let found = self.finished(&stage, &trail);
        match (found.is_empty(), cut) {
            (false, _) => Outcome::Found(found),
            (true, true) => Outcome::Cut,
            (true, false) => Outcome::None,
        }
    }

    fn extend<const W: usize>(&self, label: &Label<W>, parent: u32, next: &mut Layer<W>) {
        let (instance, tails) = (self.instance, self.tails);
        let limit_s = instance.timespan_s + self.prices.rounding_s();
        let first = label.at as usize == instance.start();
        let run = self.run_of(label);
        let b = tails.interval(label.arrive_s);
        for to in (0..instance.len() as u32).filter(|&to| !label.served.contains(to)) {
            let at = to as usize;
            // A look at the table spares most of the exact steps.
            let looks = first
                || label.arrive_s + label.paid_s + tails.through(b, label.at as usize, at)
                    <= limit_s;
            if !looks {
                continue;
            }
            let ahead = instance.step(&run, to);
            if !instance.in_time(&ahead) || ahead.depart_s > instance.timespan_s {
                continue;
            }
            let paid_s = label.paid_s - tails.prize(at);
            let bound_s = ahead.arrive_s + paid_s + tails.after(ahead.arrive_s, at);
            if bound_s <= limit_s {
                let mut served = label.served;
                served.insert(to);
                let arrive_s = ahead.arrive_s;
                next.insert(Label { served, arrive_s, paid_s, bound_s, at: to, parent });
            }
        }
    }

    fn run_of<const W: usize>(&self, label: &Label<W>) -> Run {
        let at = label.at as usize;
        if at == self.instance.start() {
            self.instance.departure()
        } else {
            stand(self.instance, at, label.arrive_s)
        }
    }

    /// The tours of the last stage, the one that ends first before all others.
    fn finished<const W: usize>(
        &self,
        stage: &[Label<W>],
        trail: &[Vec<(u32, u32)>],
    ) -> Vec<Vec<u32>> {
        let end_s = |label: &Label<W>| self.instance.finish(&self.run_of(label)).arrive_s;
        let ends = stage.iter().map(end_s).zip(0_u32..);
        let mut ends: Vec<(f64, u32)> =
            ends.filter(|(end_s, _)| *end_s <= self.instance.timespan_s).collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let order = |&(_, last): &(f64, u32)| {
            let mut at = last;
            let back = trail.iter().rev().map(|stage| {
                let (parent, stop) = stage[at as usize];
                at = parent;
                stop
            });
            let mut order: Vec<u32> = back.collect();
            order.reverse();
            order
        };
        ends.iter().take(MOST_FOUND).map(order).collect()
    }
}

impl<const W: usize> Layer<W> {
    fn new(width: usize) -> Self {
        Self { labels: Vec::new(), index: HashMap::default(), width, cut_s: f64::INFINITY }
    }

    /// Adds a label, unless one that served the same is there earlier.
    fn insert(&mut self, label: Label<W>) {
        if label.bound_s >= self.cut_s {
            return;
        }
        match self.index.entry((label.served, label.at)) {
            Entry::Occupied(old) => {
                let old = &mut self.labels[*old.get() as usize];
                if label.arrive_s < old.arrive_s {
                    *old = label;
                }
            }
            Entry::Vacant(place) => {
                place.insert(self.labels.len() as u32);
                self.labels.push(label);
                if self.labels.len() >= 2 * self.width {
                    self.thin();
                }
            }
        }
    }

    /// Gives up all but the best labels.
    fn thin(&mut self) {
        if self.labels.len() <= self.width {
            return;
        }
        let by_bound = |a: &Label<W>, b: &Label<W>| a.bound_s.total_cmp(&b.bound_s);
        let (_, first_cut, _) = self.labels.select_nth_unstable_by(self.width, by_bound);
        self.cut_s = self.cut_s.min(first_cut.bound_s);
        self.labels.truncate(self.width);
        let places = self.labels.iter().zip(0u32..);
        self.index = places.map(|(label, place)| ((label.served, label.at), place)).collect();
    }
}
