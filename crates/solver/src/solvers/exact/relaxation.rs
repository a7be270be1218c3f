//! Lower bounds by dynamic programming over relaxed paths.
//!
//! A state is a candidate, the interval of the scarce resource (time, energy or stops) at which it is
//! charged, and which of its remembered neighbours were visited; its value is the least that going on
//! to the end costs. Resources are rounded down to the beginning of their interval, so that every tour is
//! a path. Prizes, taken off the cost of each visit, come from Lagrangian multipliers.

use super::Model;
use super::memory::Memory;
use super::network::Network;
use super::prices::Prices;
use super::tally::Tally;
use super::turns::{Turn, Turns};
use crate::solvers::Budget;

/// The resource by which paths are layered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// Seconds since the departure, when charging begins.
    Time,
    /// Joules travelled and delivered, once charged.
    Energy,
    /// Stops made.
    Stops,
}

/// Which states a graph must keep open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Those of paths from the start, rounded down at every stop: enough to bound all tours.
    Paths,
    /// Those in which a tour may really be, which is later than its path: what completion bounds need.
    Tours,
}

/// The arcs and states that an improving tour may use.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// By interval and candidate, where its ways begin in `ways`; last, their number.
    pub first: Vec<usize>,
    /// The ways that are open, by interval and candidate and in the order of the arcs.
    pub ways: Vec<Way>,
    /// By interval, candidate and state of the tally, whether it may be there.
    pub live: Vec<bool>,
}

impl Graph {
    /// The ways that leave a place: an interval and candidate, counted through.
    pub fn leaving(&self, place: usize) -> &[Way] {
        &self.ways[self.first[place]..self.first[place + 1]]
    }
}

/// An arc from an interval.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Which of the arcs that leave its candidate.
    pub arc: u16,
    /// The interval at which it arrives.
    pub next: u16,
}

/// The relaxed paths of an instance.
#[derive(Debug)]
pub struct Relaxation<'n> {
    pub(super) network: &'n Network,
    pub(super) resource: Resource,
    pub(super) intervals: usize,
    /// Intervals for each second, joule or stop.
    pub(super) per_amount: f64,
    pub(super) memory: Memory,
    pub(super) tally: Tally,
    /// By candidate, where its states begin in a layer; last, their number. Within a candidate, masks run
    /// fastest, then the states of the tally.
    pub(super) offset: Vec<usize>,
    /// The graph that is evaluated.
    pub(super) graph: Graph,
    /// The graph of the other reading.
    pub(super) other: Graph,
    /// How the evaluated graph is read.
    pub(super) reading: Reading,
    /// By interval and candidate, what ending the tour costs; infinite where it cannot.
    pub(super) ends: Vec<f64>,
    /// By arc from the start, the interval at which it arrives.
    pub(super) starts: Vec<u16>,
    /// What the tour without stops costs; infinite if it breaks a limit.
    pub(super) empty: f64,
    /// What each arc means for the states at its ends.
    pub(super) turns: Turns,
    /// By candidate, and last the start: what the energy of the way to the end costs.
    home: Vec<f64>,
    /// By interval and state, the least cost of going on.
    pub(super) value: Vec<f64>,
    /// The prices that the values are for, and the least cost of a path, while the graph is as it was then.
    known: Option<(Prices, f64)>,
    /// Whether the graphs of both readings are the same.
    alike: bool,
    /// Values of one candidate while they are computed, by mask and by pattern.
    scratch: (Vec<f64>, Vec<f64>),
}

impl<'n> Relaxation<'n> {
    /// Lays out the layers: `intervals` of the resource up to `horizon`. None if the budget ends before.
    pub fn new(
        model: &Model<'_>,
        network: &'n Network,
        resource: Resource,
        intervals: usize,
        horizon: f64,
        memory: Memory,
        budget: &mut Budget<'_>,
    ) -> Option<Self> {
        let n = model.len();
        let per_amount = match resource {
            Resource::Stops => 1.0,
            _ => intervals as f64 / horizon,
        };
        let mut relaxation = Self {
            network,
            resource,
            intervals,
            per_amount,
            memory: Memory { of: Vec::new() },
            tally: Tally::new(model, Vec::new()),
            offset: Vec::new(),
            graph: Graph::default(),
            other: Graph::default(),
            reading: Reading::Paths,
            ends: vec![f64::INFINITY; intervals * n],
            starts: Vec::new(),
            empty: f64::INFINITY,
            turns: Turns::default(),
            home: Vec::new(),
            value: Vec::new(),
            known: None,
            alike: true,
            scratch: (Vec::new(), Vec::new()),
        };
        relaxation.graph = relaxation.lay_out(model, budget)?;
        relaxation.other = relaxation.graph.clone();
        relaxation.refine(memory, Tally::new(model, Vec::new()));
        Some(relaxation)
    }

    /// Evaluates the other graph from now on.
    pub fn read(&mut self, reading: Reading) {
        if self.reading != reading {
            std::mem::swap(&mut self.graph, &mut self.other);
            self.reading = reading;
            if !self.alike {
                self.known = None;
            }
        }
    }

    /// Closes to paths whatever no tour may be in, too.
    pub fn close_to_paths(&mut self) {
        let (tours, paths) = match self.reading {
            Reading::Tours => (&self.graph, &mut self.other),
            Reading::Paths => (&self.other, &mut self.graph),
        };
        paths.clone_from(tours);
        self.changed(true);
    }

    /// Says that the graphs are no longer what they were, and whether they are the same now.
    pub(super) fn changed(&mut self, alike: bool) {
        self.alike = alike;
        self.known = None;
    }

    /// Number of values that a memory and a tally ask for.
    pub fn size(&self, memory: &Memory, states: usize) -> usize {
        self.intervals * states * memory.of.iter().map(|near| 1 << near.len()).sum::<usize>()
    }

    /// Number of layers.
    pub fn intervals(&self) -> usize {
        self.intervals
    }

    /// Ways that are open, over all layers.
    pub fn ways(&self) -> usize {
        self.graph.ways.len()
    }

    /// Arcs over all layers.
    pub fn arrivals(&self) -> usize {
        self.intervals * self.network.arcs.len()
    }

    /// What is counted on the way.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// What each candidate remembers.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Changes what each candidate remembers and what is counted.
    /// The new tally counts the demands of the old one first, so that what was closed stays so.
    pub fn refine(&mut self, memory: Memory, tally: Tally) {
        let n = memory.of.len();
        let before = self.tally.states;
        if tally.states > before {
            for graph in [&mut self.graph, &mut self.other] {
                let places = graph.live.chunks_exact(before);
                graph.live = places.flat_map(|live| live.repeat(tally.states / before)).collect();
            }
        }
        self.offset = vec![0; n + 1];
        for i in 0..n {
            self.offset[i + 1] = self.offset[i] + (tally.states << memory.of[i].len());
        }
        self.turns = Turns::new(self.network, &memory, &self.offset);
        self.value = vec![f64::INFINITY; self.intervals * self.offset[n]];
        self.memory = memory;
        self.tally = tally;
        self.changed(self.alike);
        for graph in [&mut self.graph, &mut self.other] {
            self.tally.rule_out(&mut graph.live, self.intervals);
        }
    }

    /// The interval that an amount of the resource lies in.
    #[inline]
    pub(super) fn interval(&self, amount: f64) -> usize {
        // A hair less, so that rounding never makes a path later than it is.
        ((amount * (1.0 - 1e-12) * self.per_amount) as usize).min(self.intervals - 1)
    }

    /// Values of all states for these prices; the least cost of a path from start to end. None if the budget ends
    /// before: then the values mean nothing.
    pub fn evaluate(&mut self, prices: &Prices, budget: &mut Budget<'_>) -> Option<f64> {
        if let Some((known, value)) = &self.known
            && known == prices
        {
            return Some(*value);
        }
        self.known = None;
        let n = self.offset.len() - 1;
        let total = self.offset[n];
        for (turn, arc) in self.turns.all.iter_mut().zip(&self.network.arcs) {
            turn.cost = prices.of(arc);
        }
        self.home.clear();
        self.home.extend(self.network.home_j.iter().map(|home_j| prices.per_j * home_j));
        for b in (0..self.intervals).rev() {
            if !budget.lasts() {
                return None;
            }
            self.value[b * total..(b + 1) * total].fill(f64::INFINITY);
            // Paths that stay within an interval are followed until none of them gets cheaper.
            let within: Vec<usize> = (0..n).filter(|&i| self.pull(b, i).1).collect();
            for _pass in 1..n {
                let mut fell = false;
                for &i in &within {
                    fell |= self.pull(b, i).0;
                }
                if !fell {
                    break;
                }
            }
        }
        let first = self.first_arc(prices).map_or(f64::INFINITY, |(value, ..)| value);
        let value = first.min(self.empty());
        self.known = Some((prices.clone(), value));
        Some(value)
    }

    /// States of the tally that are open at a candidate.
    pub(super) fn live(&self, b: usize, i: usize) -> &[bool] {
        let n = self.offset.len() - 1;
        &self.graph.live[(b * n + i) * self.tally.states..(b * n + i + 1) * self.tally.states]
    }

    /// The ways that leave a candidate in an interval, with what they mean.
    pub(super) fn ways_from(&self, b: usize, i: usize) -> impl Iterator<Item = (usize, &Turn)> {
        let n = self.offset.len() - 1;
        let turns = &self.turns.all[self.network.leaving(i)];
        let ways = self.graph.leaving(b * n + i).iter();
        ways.map(move |way| (way.next as usize, &turns[way.arc as usize]))
    }

    /// Values at a candidate from those ahead of it; whether one fell, and whether it looks at others of its
    /// own interval.
    fn pull(&mut self, b: usize, i: usize) -> (bool, bool) {
        if self.live(b, i).iter().all(|live| !live) {
            return (false, false);
        }
        let (n, total) = (self.offset.len() - 1, self.offset[self.offset.len() - 1]);
        let masks = 1 << self.memory.of[i].len();
        let own = b * total + self.offset[i];
        let (mut best, mut cells) = std::mem::take(&mut self.scratch);
        let patterns = &self.turns.patterns[i];
        let width = patterns.cells();
        cells.clear();
        cells.resize(width * self.tally.states, f64::INFINITY);
        cells[width * self.tally.met() + patterns.all()] = self.ends[b * n + i] + self.home[i];
        let live = self.live(b, i);
        let mut within = false;
        for (state, cells) in cells.chunks_exact_mut(width).enumerate().filter(|(s, _)| live[*s]) {
            for (next, turn) in self.ways_from(b, i) {
                within |= next == b;
                let counted = turn.counted(self.tally.after(state, turn.to));
                let ahead = &self.value[next * total + counted..(next + 1) * total];
                // Without branches on the values, which follow no order.
                self.turns.each_head(turn, |cell, head| {
                    let value = turn.cost + ahead[head];
                    cells[cell] = if value < cells[cell] { value } else { cells[cell] };
                });
            }
        }
        best.resize(masks * self.tally.states, f64::INFINITY);
        for (best, cells) in best.chunks_exact_mut(masks).zip(cells.chunks_exact_mut(width)) {
            patterns.fold(cells, best);
        }
        if !live[self.tally.met()] {
            best[masks * self.tally.met()..].fill(f64::INFINITY);
        }
        let values = &mut self.value[own..own + best.len()];
        let fell = values.iter().zip(&best).any(|(old, new)| new < old);
        values.copy_from_slice(&best);
        self.scratch = (best, cells);
        (fell, within)
    }

    /// What the tour without stops costs; infinite if it may not be made.
    fn empty(&self) -> f64 {
        let home = self.home[self.home.len() - 1];
        if self.tally.met() == 0 { self.empty + home } else { f64::INFINITY }
    }

    /// Where the values of a candidate begin.
    #[inline]
    pub(super) fn states(&self, b: usize, candidate: u32, tally: usize) -> usize {
        let i = candidate as usize;
        b * self.offset[self.offset.len() - 1] + self.offset[i] + (tally << self.memory.of[i].len())
    }

    /// The best first arc: cost to the end, interval and candidate.
    fn first_arc(&self, prices: &Prices) -> Option<(f64, usize, u32)> {
        let firsts =
            self.network.leaving(self.offset.len() - 1).zip(&self.starts).map(|(a, &b)| {
                let (arc, b) = (self.network.arcs[a], b as usize);
                let value = self.value[self.states(b, arc.to, self.tally.after(0, arc.to))];
                (prices.of(&arc) + value, b, arc.to)
            });
        firsts.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The candidates of a cheapest path of the last evaluation, in order.
    pub fn path(&self, prices: &Prices) -> Vec<u32> {
        let n = self.offset.len() - 1;
        let mut path = Vec::new();
        let Some((value, mut b, mut at)) = self.first_arc(prices) else { return path };
        if value >= self.empty() || value == f64::INFINITY {
            return path;
        }
        let (mut mask, mut tally) = (0, self.tally.after(0, at));
        let (mut masks, mut matched) = (Vec::new(), Vec::new());
        loop {
            path.push(at);
            let i = at as usize;
            let patterns = &self.turns.patterns[i];
            masks.clear();
            masks.resize(1 << self.memory.of[i].len(), f64::INFINITY);
            masks[mask] = 0.0;
            matched.resize(patterns.cells(), f64::INFINITY);
            patterns.spread(&masks, &mut matched);
            let met = tally == self.tally.met();
            let end = if met { self.ends[b * n + i] + self.home[i] } else { f64::INFINITY };
            let mut best = (end, None);
            for (next, turn) in self.ways_from(b, i) {
                let counted = self.tally.after(tally, turn.to);
                self.turns.each_head(turn, |cell, head| {
                    let ahead = next * self.offset[n] + head + turn.counted(counted);
                    let value = turn.cost + matched[cell] + self.value[ahead];
                    if value < best.0 {
                        let mask = head - self.offset[turn.to as usize];
                        best = (value, Some((next, turn.to, mask, counted)));
                    }
                });
            }
            match best.1 {
                // A path in one interval could go round; no tour has more stops than this.
                Some(next) if path.len() < 4 * self.intervals + n => (b, at, mask, tally) = next,
                _ => return path,
            }
        }
    }

    /// The energy that a path takes at least, in joules, home again.
    pub fn energy_j(&self, model: &Model<'_>, path: &[u32]) -> f64 {
        let mut here = model.len();
        let mut energy_j = 0.0;
        for &next in path {
            let arcs = &self.network.arcs[self.network.leaving(here)];
            let arc = arcs.iter().find(|arc| arc.to == next);
            energy_j += arc.map_or(0.0, |arc| arc.energy_j);
            here = next as usize;
        }
        energy_j + self.network.home_j[here]
    }

    /// The candidates to which ways are open from one that is charged at this amount.
    pub fn heads(&self, candidate: u32, amount: f64, stops: usize) -> impl Iterator<Item = u32> {
        self.ways_from(self.layer(amount, stops), candidate as usize).map(|(_, turn)| turn.to)
    }

    /// The layer of a tour that is somewhere with so many stops, this one too.
    #[inline]
    fn layer(&self, amount: f64, stops: usize) -> usize {
        match self.resource {
            Resource::Stops => (stops - 1).min(self.intervals - 1),
            _ => self.interval(amount),
        }
    }

    /// The least cost of going on from a candidate, of which those that `visited` holds for are served.
    #[inline]
    pub fn go_on(
        &self,
        candidate: u32,
        amount: f64,
        stops: usize,
        tally: usize,
        visited: impl Fn(u32) -> bool,
    ) -> f64 {
        let b = self.layer(amount, stops);
        self.value[self.states(b, candidate, tally) + self.memory.mask(candidate, visited)]
    }

    /// The resource by which paths are layered.
    pub fn resource(&self) -> Resource {
        self.resource
    }
}
