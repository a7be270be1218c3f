//! Search, nearly best first, over partial tours, with dominance, under completion bounds.
//!
//! A label is a partial tour. One dominates another at the same stop where whatever follows the other can
//! follow it no worse. Labels whose bound does not beat the incumbent are dropped, so that an empty queue
//! proves the incumbent.

use std::collections::HashMap;

use super::bits::Bits;
use super::label::{Entry, Label, NONE, dominates, is_interchangeable, key};
use super::multipliers::Multipliers;
use super::queue::Queue;
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

/// A search under fixed completion bounds.
pub struct Search<'s, 'a, const W: usize> {
    model: &'s Model<'a>,
    paths: &'s Relaxation<'s>,
    multipliers: &'s Multipliers,
    /// All candidates.
    all: Bits<W>,
    /// By demand.
    members: Vec<Bits<W>>,
    labels: Vec<Label<W>>,
    queue: Queue,
    /// By key, the last label made under it.
    heads: HashMap<u64, u32, rustc_hash::FxBuildHasher>,
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
        size_of::<Label<W>>() + 2 * size_of::<Entry>() + 2 * size_of::<(u64, u32)>();

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
            all: Bits::of(0..model.len() as u32),
            members,
            labels: Vec::new(),
            queue: Queue::new(multipliers.bound, incumbent.cutoff()),
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
        while let Some(entry) = self.queue.pop() {
            if entry.bound >= self.incumbent.cutoff() {
                continue;
            }
            if self.labels.len() >= limit {
                let least = entry.bound.min(self.queue.bound());
                let come = (least - bound) / (self.incumbent.cutoff() - bound);
                if limit == more || come < PROMISING {
                    return End::Open(least);
                }
                limit = more;
            }
            if !budget.spend() {
                return End::Open(entry.bound.min(self.queue.bound()));
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
        self.labels.push(root);
        self.complete(0);
        self.queue.push(Entry { bound: self.multipliers.bound, stops: 0, label: 0 });
    }

    /// Looks for a better tour and proves nothing: of the partial tours with as many stops, the `width` best are
    /// followed.
    pub fn dive(&mut self, width: usize, budget: &mut Budget<'_>) {
        self.begin();
        loop {
            let level = self.queue.drain();
            if level.is_empty() || self.incumbent.suffices() || !budget.spend() {
                return;
            }
            for entry in level.into_iter().take(width) {
                if entry.bound < self.incumbent.cutoff()
                    && !self.labels[entry.label as usize].dominated
                {
                    self.expand(entry);
                }
            }
        }
    }

    fn expand(&mut self, entry: Entry) {
        let label = self.labels[entry.label as usize].clone();
        let pool = self.useful(&label).minus(&label.served);
        // No better tour takes a way that is closed; whom it leads to may be reached over others.
        let mut heads = pool;
        if label.stops > 0 {
            let (at, stops) = (label.run.node, label.stops as usize);
            heads = heads.both(&Bits::of(self.paths.heads(at, self.amount(&label.run), stops)));
        }
        let mut ahead = std::mem::take(&mut self.ahead);
        ahead.clear();
        let mut in_reach = Bits::EMPTY;
        for to in heads.iter() {
            let run = self.model.wide.step(&label.run, to);
            if self.is_legal(&run) {
                in_reach.insert(to);
                let bound = self.bound(&label, &run).max(entry.bound);
                if bound < self.incumbent.cutoff() {
                    ahead.push((run, bound));
                }
            }
        }
        if !ahead.is_empty() {
            self.follow(&label, entry.label, &ahead, pool.minus(&heads), in_reach);
        }
        self.ahead = ahead;
    }

    /// Extends a label by those of the runs `ahead` after which every demand can still be met. Of the others whom it
    /// does not serve, those `in_reach` can be reached from it, those `beyond` perhaps.
    fn follow(
        &mut self,
        label: &Label<W>,
        index: u32,
        ahead: &[(Run, f64)],
        beyond: Bits<W>,
        in_reach: Bits<W>,
    ) {
        let model = self.model;
        if model.demands.is_empty() {
            for (run, bound) in ahead {
                self.extend(label, index, *run, *bound);
            }
            return;
        }
        // Where no detour is a short cut, who cannot be reached now never can.
        let mut left = in_reach;
        if !model.direct {
            left = self.all.minus(&label.served);
        } else {
            beyond
                .iter()
                .filter(|&to| self.may_reach(&label.run, to))
                .for_each(|to| left.insert(to));
        }
        let mut open = std::mem::take(&mut self.open);
        open.clear();
        open.extend(label.open.iter().map(|d| {
            let members = self.members[d as usize];
            (members, model.demands[d as usize].needs - members.common(&label.served))
        }));
        if self.timetable.keeps(model, &label.run, &open, &mut left) {
            for (run, bound) in ahead {
                if left.contains(run.node) && self.timetable.admits(&label.run, run) {
                    self.extend(label, index, *run, *bound);
                }
            }
        }
        self.open = open;
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
            self.queue.push(Entry { bound, stops: label.stops + 1, label: new });
            self.complete(new);
        }
    }

    /// Whether all limits were kept so far.
    fn is_legal(&self, run: &Run) -> bool {
        let instance = &self.model.wide;
        instance.in_time(run)
            && run.depart_s <= instance.timespan_s
            && instance.energy_j(run) <= instance.capacity_j
    }

    /// Whether a candidate may be reached by its deadline; of one that moves, whether it can.
    fn may_reach(&self, run: &Run, to: u32) -> bool {
        let instance = &self.model.wide;
        if instance.moving {
            return self.is_legal(&instance.step(run, to));
        }
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
        let useful = self.useful(&new);
        let head = self.heads.entry(key(&new, &useful)).or_insert(NONE);
        let mut other = *head;
        while other != NONE {
            let old = &self.labels[other as usize];
            if !old.dominated
                && dominates(self.model, old, &new)
                && is_interchangeable(old, &new, &useful)
            {
                return None;
            }
            other = old.next;
        }
        other = *head;
        while other != NONE {
            let old = &mut self.labels[other as usize];
            old.dominated |=
                dominates(self.model, &new, old) && is_interchangeable(old, &new, &useful);
            other = old.next;
        }
        new.next = *head;
        let index = self.labels.len() as u32;
        *head = index;
        self.labels.push(new);
        Some(index)
    }

    /// Who is worth a stop after a label, and of whom it matters whether it served them: where only open demands count,
    /// their members.
    fn useful(&self, label: &Label<W>) -> Bits<W> {
        if !self.model.useful_only {
            return self.all;
        }
        let members = label.open.iter().map(|d| &self.members[d as usize]);
        members.fold(Bits::EMPTY, |useful, members| useful.union(members))
    }

    /// Takes a label as a whole tour, if it is one and a better one.
    fn complete(&mut self, index: u32) {
        let (model, label) = (self.model, &self.labels[index as usize]);
        let cutoff = self.incumbent.cutoff();
        if !label.open.is_empty() || model.cost(label.run.distance_m, label.gain) >= cutoff {
            return;
        }
        let home = model.wide.finish(&label.run);
        if model.wide.keeps_limits(&home) && model.cost(home.distance_m, label.gain) < cutoff {
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
