//! Lower bounds by dynamic programming over relaxed paths.
//!
//! A state is a candidate, the interval of the scarce resource (time, energy or stops) at which it is
//! charged, and which of its remembered neighbours were visited; its value is the least that going on
//! to the end costs. Resources are rounded down to the beginning of their interval, so that every tour is
//! a path. Prizes, taken off the cost of each visit, come from Lagrangian multipliers.

use super::Model;
use super::memory::Memory;
use super::network::Network;
use super::tally::Tally;

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
    /// By interval and arc, the interval at which the arc arrives.
    pub arrives: Vec<u16>,
    /// By interval, candidate and state of the tally, whether it may be there.
    pub live: Vec<bool>,
}

/// An arc that cannot be used from an interval.
pub(super) const CLOSED: u16 = u16::MAX;

/// The relaxed paths of an instance.
#[derive(Debug)]
pub struct Relaxation<'n> {
    pub(super) network: &'n Network,
    pub(super) resource: Resource,
    pub(super) intervals: usize,
    pub(super) width: f64,
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
    /// By arc and mask, the mask at its end.
    pub(super) next_mask: Vec<u16>,
    /// By arc, where its masks begin.
    pub(super) masks: Vec<usize>,
    /// By arc, the bit under which its tail remembers its head.
    pub(super) back: Vec<u32>,
    /// By interval and state, the least cost of going on.
    pub(super) value: Vec<f64>,
    /// Values of one candidate while they are computed.
    scratch: Vec<f64>,
}

impl<'n> Relaxation<'n> {
    /// Lays out the layers: `intervals` of the resource up to `horizon`.
    pub fn new(
        model: &Model<'_>,
        network: &'n Network,
        resource: Resource,
        intervals: usize,
        horizon: f64,
        memory: Memory,
    ) -> Self {
        let n = model.len();
        let width = match resource {
            Resource::Stops => 1.0,
            _ => horizon / intervals as f64,
        };
        let mut relaxation = Self {
            network,
            resource,
            intervals,
            width,
            memory: Memory { of: Vec::new() },
            tally: Tally::new(model, Vec::new()),
            offset: Vec::new(),
            graph: Graph::default(),
            other: Graph::default(),
            reading: Reading::Paths,
            ends: vec![f64::INFINITY; intervals * n],
            starts: Vec::new(),
            empty: f64::INFINITY,
            next_mask: Vec::new(),
            masks: Vec::new(),
            back: Vec::new(),
            value: Vec::new(),
            scratch: Vec::new(),
        };
        relaxation.graph = relaxation.lay_out(model);
        relaxation.other = relaxation.graph.clone();
        relaxation.refine(memory, Tally::new(model, Vec::new()));
        relaxation
    }

    /// Evaluates the other graph from now on.
    pub fn read(&mut self, reading: Reading) {
        if self.reading != reading {
            std::mem::swap(&mut self.graph, &mut self.other);
            self.reading = reading;
        }
    }

    /// Number of values that a memory and a tally ask for.
    pub fn size(&self, memory: &Memory, states: usize) -> usize {
        self.intervals * states * memory.of.iter().map(|near| 1 << near.len()).sum::<usize>()
    }

    /// Number of layers.
    pub fn intervals(&self) -> usize {
        self.intervals
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
        for graph in [&mut self.graph, &mut self.other] {
            let places = graph.live.chunks_exact(before);
            graph.live = places.flat_map(|live| live.repeat(tally.states / before)).collect();
        }
        self.offset = vec![0; n + 1];
        for i in 0..n {
            self.offset[i + 1] = self.offset[i] + (tally.states << memory.of[i].len());
        }
        let network = self.network;
        self.masks.clear();
        self.next_mask.clear();
        self.back.clear();
        for from in 0..n {
            let near = &memory.of[from];
            for arc in &network.arcs[network.leaving(from)] {
                self.masks.push(self.next_mask.len());
                let bit = near.binary_search(&arc.to).map_or(0, |bit| 1 << bit);
                self.back.push(bit);
                let ahead = &memory.of[arc.to as usize];
                let own = ahead.binary_search(&(from as u32)).map_or(0, |bit| 1_u16 << bit);
                let kept: Vec<u16> = near
                    .iter()
                    .map(|other| ahead.binary_search(other).map_or(0, |bit| 1_u16 << bit))
                    .collect();
                for mask in 0..1_usize << near.len() {
                    let held = kept.iter().enumerate().filter(|(bit, _)| mask >> bit & 1 == 1);
                    self.next_mask.push(held.fold(own, |next, (_, bit)| next | bit));
                }
            }
        }
        self.value = vec![f64::INFINITY; self.intervals * self.offset[n]];
        self.memory = memory;
        self.tally = tally;
    }

    /// The interval that an amount of the resource lies in.
    #[inline]
    pub(super) fn interval(&self, amount: f64) -> usize {
        // A hair less, so that rounding never makes a path later than it is.
        ((amount * (1.0 - 1e-12) / self.width) as usize).min(self.intervals - 1)
    }

    /// Values of all states for these prizes; the least cost of a path from start to end.
    pub fn evaluate(&mut self, prizes: &[f64]) -> f64 {
        let (n, total) = (prizes.len(), self.offset[prizes.len()]);
        for b in (0..self.intervals).rev() {
            self.value[b * total..(b + 1) * total].fill(f64::INFINITY);
            // Paths that stay within an interval are followed until none of them gets cheaper.
            for _pass in 0..n.max(1) {
                let (mut fell, mut within) = (false, false);
                for i in 0..n {
                    let (own_fell, own_within) = self.pull(prizes, b, i);
                    fell |= own_fell;
                    within |= own_within;
                }
                if !fell || !within {
                    break;
                }
            }
        }
        self.first_arc(prizes).map_or(self.empty(), |(value, ..)| value.min(self.empty()))
    }

    /// States of the tally that are open at a candidate.
    pub(super) fn live(&self, b: usize, i: usize) -> &[bool] {
        let n = self.offset.len() - 1;
        &self.graph.live[(b * n + i) * self.tally.states..(b * n + i + 1) * self.tally.states]
    }

    /// Values at a candidate from those ahead of it; whether one fell, and whether it looks at others of its
    /// own interval.
    fn pull(&mut self, prizes: &[f64], b: usize, i: usize) -> (bool, bool) {
        if self.live(b, i).iter().all(|live| !live) {
            return (false, false);
        }
        let network = self.network;
        let (n, arcs, total) = (prizes.len(), network.arcs.len(), self.offset[prizes.len()]);
        let masks = 1 << self.memory.of[i].len();
        let own = b * total + self.offset[i];
        let mut best = std::mem::take(&mut self.scratch);
        best.clear();
        best.resize(masks * self.tally.states, f64::INFINITY);
        best[masks * self.tally.met()..].fill(self.ends[b * n + i]);
        let live = self.live(b, i);
        let mut within = false;
        for a in network.leaving(i) {
            let next = self.graph.arrives[b * arcs + a];
            if next == CLOSED {
                continue;
            }
            within |= next as usize == b;
            let to = network.arcs[a].to;
            let states = next as usize * total + self.offset[to as usize];
            let cost = network.arcs[a].cost - prizes[to as usize];
            let next_masks = &self.next_mask[self.masks[a]..self.masks[a] + masks];
            let masks_ahead = 1 << self.memory.of[to as usize].len();
            let back = self.back[a] as usize;
            for (state, best) in best.chunks_exact_mut(masks).enumerate() {
                if !live[state] {
                    continue;
                }
                let states = states + self.tally.after(state, to) * masks_ahead;
                let ahead = &self.value[states..states + masks_ahead];
                for (mask, (best, &next_mask)) in best.iter_mut().zip(next_masks).enumerate() {
                    let value = cost + ahead[next_mask as usize];
                    if value < *best && back & mask == 0 {
                        *best = value;
                    }
                }
            }
        }
        if !live[self.tally.met()] {
            best[masks * self.tally.met()..].fill(f64::INFINITY);
        }
        let values = &mut self.value[own..own + best.len()];
        let fell = values.iter().zip(&best).any(|(old, new)| new < old);
        values.copy_from_slice(&best);
        self.scratch = best;
        (fell, within)
    }

    /// What the tour without stops costs; infinite if it may not be made.
    fn empty(&self) -> f64 {
        if self.tally.met() == 0 { self.empty } else { f64::INFINITY }
    }

    /// Where the values of a candidate begin.
    #[inline]
    pub(super) fn states(&self, b: usize, candidate: u32, tally: usize) -> usize {
        let i = candidate as usize;
        b * self.offset[self.offset.len() - 1] + self.offset[i] + (tally << self.memory.of[i].len())
    }

    /// The best first arc: cost to the end, interval and candidate.
    fn first_arc(&self, prizes: &[f64]) -> Option<(f64, usize, u32)> {
        let firsts = self.network.leaving(prizes.len()).zip(&self.starts).map(|(a, &b)| {
            let (arc, b) = (self.network.arcs[a], b as usize);
            let value = self.value[self.states(b, arc.to, self.tally.after(0, arc.to))];
            (arc.cost - prizes[arc.to as usize] + value, b, arc.to)
        });
        firsts.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The candidates of a cheapest path of the last evaluation, in order.
    pub fn path(&self, prizes: &[f64]) -> Vec<u32> {
        let network = self.network;
        let (n, arcs) = (prizes.len(), network.arcs.len());
        let mut path = Vec::new();
        let Some((value, mut b, mut at)) = self.first_arc(prizes) else { return path };
        if value >= self.empty() || value == f64::INFINITY {
            return path;
        }
        let (mut mask, mut tally) = (0, self.tally.after(0, at));
        loop {
            path.push(at);
            let i = at as usize;
            let end = if tally == self.tally.met() { self.ends[b * n + i] } else { f64::INFINITY };
            let mut best = (end, None);
            for a in network.leaving(i) {
                let next = self.graph.arrives[b * arcs + a];
                if next == CLOSED || self.back[a] as usize & mask != 0 {
                    continue;
                }
                let to = network.arcs[a].to;
                let ahead = self.next_mask[self.masks[a] + mask] as usize;
                let counted = self.tally.after(tally, to);
                let value = network.arcs[a].cost - prizes[to as usize]
                    + self.value[self.states(next as usize, to, counted) + ahead];
                if value < best.0 {
                    best = (value, Some((next as usize, to, ahead, counted)));
                }
            }
            match best.1 {
                // A path in one interval could go round; no tour has more stops than this.
                Some(next) if path.len() < 4 * self.intervals + n => (b, at, mask, tally) = next,
                _ => return path,
            }
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
        let b = match self.resource {
            Resource::Stops => (stops - 1).min(self.intervals - 1),
            _ => self.interval(amount),
        };
        self.value[self.states(b, candidate, tally) + self.memory.mask(candidate, visited)]
    }

    /// The resource by which paths are layered.
    pub fn resource(&self) -> Resource {
        self.resource
    }
}
