//! Reduced cost fixing: arcs that no path uses whose cost beats the cutoff are closed for good.

use super::prices::Prices;
use super::relaxation::{Reading, Relaxation, Resource};
use super::turns::Turn;
use crate::solvers::Budget;

impl Relaxation<'_> {
    /// Closes, in every interval, the arcs over which the least cost of a path is `most` or more. The
    /// values must be those of these prices. Whether the budget lasted: if not, nothing more may be asked of these
    /// paths.
    #[must_use]
    pub fn fix(&mut self, prices: &Prices, most: f64, budget: &mut Budget<'_>) -> bool {
        let network = self.network;
        let n = self.offset.len() - 1;
        let total = self.offset[n];
        self.changed(false);
        let mut reached = vec![f64::INFINITY; self.intervals * total];
        for (a, &b) in network.leaving(n).zip(&self.starts) {
            let to = network.arcs[a].to;
            let state = self.states(b as usize, to, self.tally.after(0, to));
            reached[state] = prices.of(&network.arcs[a]);
        }
        let mut begun = Begun::default();
        let mut within = Vec::new();
        let mut kept = 0;
        for b in 0..self.intervals {
            if !budget.lasts() {
                return false;
            }
            // A path is rounded down at every stop: a tour may be later than its path, never earlier.
            if b > 0 && self.reading == Reading::Tours && self.resource != Resource::Stops {
                let (before, own) = reached.split_at_mut(b * total);
                let before = &before[(b - 1) * total..];
                own.iter_mut().zip(before).for_each(|(own, before)| *own = own.min(*before));
            }
            // Paths that stay within an interval are followed until none of them gets cheaper.
            let stays = |&i: &usize| {
                self.graph.leaving(b * n + i).iter().any(|way| usize::from(way.next) == b)
            };
            within.clear();
            within.extend((0..n).filter(stays));
            for _pass in 0..n {
                let mut again = false;
                for &i in &within {
                    if self.begin(b, i, most, &reached, &mut begun) {
                        again |= self.push(b, i, &begun, &mut reached);
                    }
                }
                if !again {
                    break;
                }
            }
            for i in 0..n {
                self.begin(b, i, most, &reached, &mut begun);
                kept = self.close(b, i, most, &begun, &mut reached, kept);
            }
        }
        self.graph.first[self.intervals * n] = kept;
        self.graph.ways.truncate(kept);
        true
    }

    /// What it costs to be in each state of a candidate, infinite where going on from there leads to no path
    /// that costs less than `most`; whether one does.
    fn begin(&self, b: usize, i: usize, most: f64, reached: &[f64], begun: &mut Begun) -> bool {
        let total = self.offset[self.offset.len() - 1];
        let own = b * total + self.offset[i]..b * total + self.offset[i + 1];
        let masks = 1 << self.memory.of[i].len();
        let patterns = &self.turns.patterns[i];
        let width = patterns.cells();
        begun.any.clear();
        begun.cells.resize(width * self.tally.states, f64::INFINITY);
        let states =
            reached[own.clone()].chunks_exact(masks).zip(self.value[own].chunks_exact(masks));
        for ((reached, value), cells) in states.zip(begun.cells.chunks_exact_mut(width)) {
            begun.costs.clear();
            let costs = reached.iter().zip(value);
            begun.costs.extend(costs.map(
                |(&begun, value)| {
                    if begun + value < most { begun } else { f64::INFINITY }
                },
            ));
            let any = begun.costs.iter().any(|cost| *cost < f64::INFINITY);
            begun.any.push(any);
            if any {
                patterns.spread(&begun.costs, cells);
            }
        }
        begun.any.contains(&true)
    }

    /// Carries the costs at a candidate over its ways that stay within the interval; whether a cost fell.
    fn push(&self, b: usize, i: usize, begun: &Begun, reached: &mut [f64]) -> bool {
        let mut fell = false;
        for (next, turn) in self.ways_from(b, i).filter(|(next, _)| *next == b) {
            self.over(i, next, turn, begun, |begun, ahead| {
                let (through, known) = (begun + turn.cost, reached[ahead]);
                fell |= through < known;
                reached[ahead] = if through < known { through } else { known };
            });
        }
        fell
    }

    /// Closes a candidate's states that nothing begins and its ways that lead to no path that costs less than
    /// `most`, and carries the costs over the others. The ways kept so far, over all candidates, are the first
    /// `kept`; how many they are then.
    fn close(
        &mut self,
        b: usize,
        i: usize,
        most: f64,
        begun: &Begun,
        reached: &mut [f64],
        mut kept: usize,
    ) -> usize {
        let (n, tallies) = (self.offset.len() - 1, self.tally.states);
        let place = b * n + i;
        let live = &mut self.graph.live[place * tallies..(place + 1) * tallies];
        live.iter_mut().zip(&begun.any).for_each(|(live, any)| *live &= any);
        let ways = self.graph.first[place]..self.graph.first[place + 1];
        self.graph.first[place] = kept;
        if !begun.any.contains(&true) {
            return kept;
        }
        let first = self.network.leaving(i).start;
        for way in ways {
            let way = self.graph.ways[way];
            let turn = &self.turns.all[first + way.arc as usize];
            let mut least = f64::INFINITY;
            self.over(i, way.next as usize, turn, begun, |begun, ahead| {
                let (begun, known) = (begun + turn.cost, reached[ahead]);
                reached[ahead] = if begun < known { begun } else { known };
                let through = begun + self.value[ahead];
                least = if through < least { through } else { least };
            });
            if least < most {
                self.graph.ways[kept] = way;
                kept += 1;
            }
        }
        kept
    }

    /// What it costs at least to begin a way, with the state at its head, for every pattern from which it is open.
    #[inline]
    fn over(
        &self,
        i: usize,
        next: usize,
        turn: &Turn,
        begun: &Begun,
        mut each: impl FnMut(f64, usize),
    ) {
        let layer = next * self.offset[self.offset.len() - 1];
        let states = begun.cells.chunks_exact(self.turns.patterns[i].cells()).zip(&begun.any);
        for (tally, (cells, _)) in states.enumerate().filter(|(_, (_, any))| **any) {
            let ahead = layer + turn.counted(self.tally.after(tally, turn.to));
            self.turns.each_head(turn, |cell, head| each(cells[cell], ahead + head));
        }
    }
}

/// The costs at which paths begin to go on from a candidate.
#[derive(Debug, Default)]
struct Begun {
    /// By state of the tally and pattern, the least.
    cells: Vec<f64>,
    /// By state of the tally, whether any is open.
    any: Vec<bool>,
    /// By mask, for one state of the tally, while cells are filled.
    costs: Vec<f64>,
}
