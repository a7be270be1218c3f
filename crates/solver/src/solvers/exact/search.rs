//! Best-first search over partial tours, with dominance, under completion bounds.
//!
//! A label is a partial tour. One dominates another at the same stop where whatever follows the other can
//! follow it no worse. Labels whose bound does not beat the incumbent are dropped, so that an empty queue
//! proves the incumbent.

use std::collections::{BinaryHeap, HashMap};

use super::bits::Bits;
use super::label::{Entry, Label, NONE, dominates};
use super::multipliers::Multipliers;
use super::relaxation::{Relaxation, Resource};
use super::timetable::Timetable;
use super::{Incumbent, Model};
use crate::solvers::Budget;
use crate::tour::Run;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// Every partial tour was followed or ruled out.
    Closed,
    /// Too many labels, or the budget is spent: no tour costs less than this.
    Open(f64),
}

/// Bounds rise the more slowly the more labels there are. Where they have come this share of their way to the
/// incumbent, so many times as many labels mostly bring them there.
const PROMISING: f64 = 0.62;
const MORE: usize = 5;

type Key<const W: usize> = (Bits<W>, Bits<W>, u32);

/// A search under fixed completion bounds.
pub struct Search<'s, 'a, const W: usize> {
    model: &'s Model<'a>,
    paths: &'s Relaxation<'s>,
    multipliers: &'s Multipliers,
    members: Vec<Bits<W>>,
    labels: Vec<Label<W>>,
    heap: BinaryHeap<Entry>,
    heads: HashMap<Key<W>, u32, rustc_hash::FxBuildHasher>,
    incumbent: &'s mut Incumbent,
    /// The runs that may follow a label and what tours that go on so cost at least, while it is expanded.
    ahead: Vec<(Run, f64)>,
    /// By open demand of that label, its members and how many more of them it needs.
    open: Vec<(Bits<W>, u32)>,
    timetable: Timetable,
}

impl<'s, 'a, const W: usize> Search<'s, 'a, W> {
    /// Memory that a label takes, with its places in the queue and under its key.
    pub const LABEL_BYTES: usize =
        size_of::<Label<W>>() + size_of::<Entry>() + 2 * size_of::<(Key<W>, u32)>();

    pub fn new(
        model: &'s Model<'a>,
        paths: &'s Relaxation<'s>,
        multipliers: &'s Multipliers,
        incumbent: &'s mut Incumbent,
    ) -> Self {
        let members = model.demands.iter().map(|d| Bits::of(d.members.iter().copied())).collect();
        Self {
            model,
            paths,
            multipliers,
            members,
            labels: Vec::new(),
            heap: BinaryHeap::new(),
            heads: HashMap::default(),
            incumbent,
            ahead: Vec::new(),
            open: Vec::new(),
            timetable: Timetable::new(model),
        }
    }

    /// Searches until nothing is left, or the budget is spent, or so many `labels` were made; where these have brought
    /// the bound well on its way, more of them, but at `most` so many.
    pub fn run(&mut self, labels: usize, most: usize, budget: &mut Budget<'_>) -> End {
        let more = most.min(MORE * labels);
        let mut limit = most.min(labels);
        let bound = self.multipliers.bound;
        self.begin();
        while let Some(entry) = self.heap.pop() {
            if entry.bound >= self.incumbent.cutoff() {
                break;
            }
            if self.labels.len() >= limit {
                let come = (entry.bound - bound) / (self.incumbent.cutoff() - bound);
                if limit == more || come < PROMISING {
                    return End::Open(entry.bound);
                }
                limit = more;
            }
            if !budget.spend() {
                return End::Open(entry.bound);
            }
            if !self.labels[entry.label as usize].dominated {
                self.expand(entry);
            }
            if self.incumbent.suffices() {
                return End::Closed;
            }
        }
        End::Closed
    }

    /// The tour without stops, from which all others go on.
    fn begin(&mut self) {
        let model = self.model;
        let root = Label {
            run: model.wide.departure(),
            served: Bits::EMPTY,
            open: Bits::of(0..model.demands.len() as u32),
            gain: 0.0,
            reduced: self.multipliers.constant,
            parent: NONE,
            next: NONE,
            stops: 0,
            tally: 0,
            dominated: false,
        };
        self.complete(&root, NONE);
        self.labels.push(root);
        self.heap.push(Entry { bound: self.multipliers.bound, stops: 0, label: 0 });
    }

    /// Looks for a better tour and proves nothing: of the partial tours with as many stops, the `width` best are
    /// followed.
    pub fn dive(&mut self, width: usize, budget: &mut Budget<'_>) {
        self.begin();
        while !self.heap.is_empty() && !self.incumbent.suffices() && budget.spend() {
            let level: Vec<Entry> = std::iter::from_fn(|| self.heap.pop()).take(width).collect();
            self.heap.clear();
            for entry in level {
                if entry.bound < self.incumbent.cutoff()
                    && !self.labels[entry.label as usize].dominated
                {
                    self.expand(entry);
                }
            }
        }
    }

    fn expand(&mut self, entry: Entry) {
        let model = self.model;
        let label = self.labels[entry.label as usize].clone();
        let mut pool = Bits::<W>::EMPTY;
        if model.useful_only {
            for d in label.open.iter() {
                pool = pool.union(&self.members[d as usize]);
            }
        } else {
            pool = Bits::of(0..model.len() as u32);
        }
        let mut ahead = std::mem::take(&mut self.ahead);
        ahead.clear();
        // No better tour takes a way that is closed; whom it leads to may be reached over others.
        let mut open_to = pool;
        if label.stops > 0 {
            let amount = self.amount(&label.run);
            open_to = Bits::of(self.paths.heads(label.run.node, amount, label.stops as usize));
        }
        let mut in_reach = Bits::<W>::EMPTY;
        for to in pool.minus(&label.served).iter() {
            if !open_to.contains(to) && !model.wide.moving {
                if self.may_be_in_time(&label.run, to) {
                    in_reach.insert(to);
                }
                continue;
            }
            let run = model.wide.step(&label.run, to);
            if model.wide.in_time(&run)
                && run.depart_s <= model.wide.timespan_s
                && model.wide.energy_j(&run) <= model.wide.capacity_j
            {
                in_reach.insert(to);
                if open_to.contains(to) {
                    let bound = self.bound(&label, &run).max(entry.bound);
                    if bound < self.incumbent.cutoff() {
                        ahead.push((run, bound));
                    }
                }
            }
        }
        if ahead.is_empty() {
            self.ahead = ahead;
            return;
        }
        // Where no detour is a short cut, who cannot be reached now never can.
        let mut left = in_reach;
        if !model.direct {
            left = Bits::of(0..model.len() as u32).minus(&label.served);
        }
        let mut open = std::mem::take(&mut self.open);
        open.clear();
        open.extend(label.open.iter().map(|d| {
            let members = self.members[d as usize];
            (members, model.demands[d as usize].needs - members.common(&label.served))
        }));
        if self.timetable.keeps(model, &label.run, &open, &mut left) {
            for (run, bound) in &ahead {
                if left.contains(run.node) && self.timetable.admits(&label.run, run) {
                    self.extend(&label, entry.label, *run, *bound);
                }
            }
        }
        self.open = open;
        self.ahead = ahead;
    }

    /// What every tour costs at least that goes on from a label so.
    fn bound(&self, label: &Label<W>, run: &Run) -> f64 {
        let (model, to) = (self.model, run.node);
        let served = |c| c == to || label.served.contains(c);
        let gain = label.gain + model.gains[to as usize];
        let amount = self.amount(run);
        let stops = label.stops as usize + 1;
        let tally = self.paths.tally().after(label.tally as usize, to);
        let ahead = self.paths.go_on(to, amount, stops, tally, served);
        let energy = self.multipliers.prices.per_j * model.wide.energy_j(run);
        model.cost(run.distance_m, gain) + energy + self.reduced(label, to) + ahead
            - self.multipliers.rounding
    }

    /// The multipliers' constant less the prizes collected.
    fn reduced(&self, label: &Label<W>, to: u32) -> f64 {
        let to = to as usize;
        label.reduced - self.multipliers.prices.prizes[to] + self.model.gains[to]
    }

    fn extend(&mut self, label: &Label<W>, parent: u32, run: Run, bound: f64) {
        let (model, to) = (self.model, run.node);
        let mut served = label.served;
        served.insert(to);
        let mut open = label.open;
        for &d in &model.of[to as usize] {
            if open.contains(d)
                && self.members[d as usize].common(&served) >= model.demands[d as usize].needs
            {
                open.remove(d);
            }
        }
        let new = Label {
            run,
            served,
            open,
            gain: label.gain + model.gains[to as usize],
            reduced: self.reduced(label, to),
            parent,
            next: NONE,
            stops: label.stops + 1,
            tally: self.paths.tally().after(label.tally as usize, to) as u16,
            dominated: false,
        };
        if let Some(new) = self.insert(new) {
            self.heap.push(Entry { bound, stops: label.stops + 1, label: new });
            if open.is_empty() {
                let label = self.labels[new as usize].clone();
                self.complete(&label, new);
            }
        }
    }

    /// Whether a candidate at rest may be reached by its deadline.
    fn may_be_in_time(&self, run: &Run, to: u32) -> bool {
        let instance = &self.model.wide;
        let way_m = instance.distance_m(run.node as usize, to as usize);
        let arrive_s = run.depart_s + way_m * instance.travel_spm;
        arrive_s <= instance.candidates[to as usize].due_s
    }

    /// What of the resource of the paths has been used.
    fn amount(&self, run: &Run) -> f64 {
        match self.paths.resource() {
            Resource::Time => run.arrive_s,
            Resource::Energy => self.model.wide.energy_j(run),
            Resource::Stops => 0.0,
        }
    }

    /// Adds a label unless another dominates it.
    fn insert(&mut self, mut new: Label<W>) -> Option<u32> {
        let key = self.key(&new);
        let head = self.heads.entry(key).or_insert(NONE);
        let mut other = *head;
        while other != NONE {
            let old = &self.labels[other as usize];
            if !old.dominated && dominates(self.model, old, &new) {
                return None;
            }
            other = old.next;
        }
        other = *head;
        while other != NONE {
            let old = &self.labels[other as usize];
            let (next, falls) = (old.next, dominates(self.model, &new, old));
            if falls {
                self.labels[other as usize].dominated = true;
            }
            other = next;
        }
        new.next = *head;
        let index = self.labels.len() as u32;
        *head = index;
        self.labels.push(new);
        Some(index)
    }

    /// What must be equal for one label to take another's place: where only open demands matter, those
    /// and their members not yet served; else all that is served.
    fn key(&self, label: &Label<W>) -> Key<W> {
        if !self.model.useful_only {
            return (label.served, Bits::EMPTY, label.run.node);
        }
        let mut useful = Bits::<W>::EMPTY;
        for d in label.open.iter() {
            useful = useful.union(&self.members[d as usize]);
        }
        (useful.minus(&label.served), label.open, label.run.node)
    }

    /// Takes a label as a whole tour, if it is one.
    fn complete(&mut self, label: &Label<W>, index: u32) {
        if !label.open.is_empty() {
            return;
        }
        let model = self.model;
        let home = model.wide.finish(&label.run);
        let cost = model.cost(home.distance_m, label.gain);
        if model.wide.keeps_limits(&home) && cost < self.incumbent.cutoff() {
            let order = self.order(index);
            self.incumbent.offer_wide(model, order);
        }
    }

    fn order(&self, mut index: u32) -> Vec<u32> {
        let mut order = Vec::new();
        while index != NONE {
            let label = &self.labels[index as usize];
            if label.parent != NONE {
                order.push(label.run.node);
            }
            index = label.parent;
        }
        order.reverse();
        order
    }
}
