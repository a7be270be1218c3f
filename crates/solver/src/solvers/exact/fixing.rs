//! Reduced cost fixing: arcs that no path uses whose cost beats the cutoff are closed for good.

use super::relaxation::{Reading, Relaxation, Resource, Turn};

impl Relaxation<'_> {
    /// Closes, in every interval, the arcs over which the least cost of a path is `most` or more. The
    /// values must be those of these prizes.
    pub fn fix(&mut self, prizes: &[f64], most: f64) {
        let network = self.network;
        let (n, total) = (prizes.len(), self.offset[prizes.len()]);
        let mut reached = vec![f64::INFINITY; self.intervals * total];
        for (a, &b) in network.leaving(n).zip(&self.starts) {
            let to = network.arcs[a].to;
            let state = self.states(b as usize, to, self.tally.after(0, to));
            reached[state] = network.arcs[a].cost - prizes[to as usize];
        }
        let mut begun = Vec::new();
        let mut kept = 0;
        for b in 0..self.intervals {
            // A path is rounded down at every stop: a tour may be later than its path, never earlier.
            if b > 0 && self.reading == Reading::Tours && self.resource != Resource::Stops {
                let (before, own) = reached.split_at_mut(b * total);
                let before = &before[(b - 1) * total..];
                own.iter_mut().zip(before).for_each(|(own, before)| *own = own.min(*before));
            }
            // Paths that stay within an interval are followed until none of them gets cheaper.
            for _pass in 0..n.max(1) {
                let mut again = false;
                for i in 0..n {
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
                kept = self.close(b, i, most, &begun, kept);
            }
        }
        self.graph.first[self.intervals * n] = kept;
        self.graph.ways.truncate(kept);
    }

    /// What it costs to be in each state of a candidate, infinite where going on from there leads to no path
    /// that costs less than `most`; whether one does.
    fn begin(&self, b: usize, i: usize, most: f64, reached: &[f64], begun: &mut Vec<f64>) -> bool {
        let total = self.offset[self.offset.len() - 1];
        let own = b * total + self.offset[i]..b * total + self.offset[i + 1];
        begun.clear();
        let states = reached[own.clone()].iter().zip(&self.value[own]);
        let mut any = false;
        begun.extend(states.map(|(&begun, value)| {
            let open = begun + value < most;
            any |= open;
            if open { begun } else { f64::INFINITY }
        }));
        any
    }

    /// Carries the costs at a candidate over its arcs; whether a cost within the interval fell.
    fn push(&self, b: usize, i: usize, begun: &[f64], reached: &mut [f64]) -> bool {
        let mut again = false;
        for (next, turn) in self.ways(b, i) {
            let mut fell = false;
            self.over(i, next, turn, begun, |begun, ahead| {
                let (through, known) = (begun + turn.cost, reached[ahead]);
                fell |= through < known;
                reached[ahead] = if through < known { through } else { known };
            });
            again |= fell && next == b;
        }
        again
    }

    /// Closes a candidate's states that nothing begins and its ways that lead to no path that costs less than
    /// `most`. The ways kept so far, over all candidates, are the first `kept`; how many they are then.
    fn close(&mut self, b: usize, i: usize, most: f64, begun: &[f64], mut kept: usize) -> usize {
        let (n, tallies) = (self.offset.len() - 1, self.tally.states);
        let place = b * n + i;
        let masks = begun.len() / tallies;
        let live = &mut self.graph.live[place * tallies..(place + 1) * tallies];
        for (live, begun) in live.iter_mut().zip(begun.chunks_exact(masks)) {
            *live &= begun.iter().any(|begun| *begun < f64::INFINITY);
        }
        let ways = self.graph.first[place]..self.graph.first[place + 1];
        self.graph.first[place] = kept;
        if begun.iter().all(|begun| *begun == f64::INFINITY) {
            return kept;
        }
        let first = self.network.leaving(i).start;
        for way in ways {
            let way = self.graph.ways[way];
            let turn = &self.turns[first + way.arc as usize];
            let mut least = f64::INFINITY;
            self.over(i, way.next as usize, turn, begun, |begun, ahead| {
                let through = begun + turn.cost + self.value[ahead];
                least = if through < least { through } else { least };
            });
            if least < most {
                self.graph.ways[kept] = way;
                kept += 1;
            }
        }
        kept
    }

    /// What it costs to begin a way, with the state at its head, for every state from which it is open.
    #[inline]
    fn over(
        &self,
        i: usize,
        next: usize,
        turn: &Turn,
        begun: &[f64],
        mut each: impl FnMut(f64, usize),
    ) {
        let masks = 1 << self.memory.of[i].len();
        let layer = next * self.offset[self.offset.len() - 1] + turn.states as usize;
        let next_masks = &self.next_mask[turn.masks as usize..turn.masks as usize + masks];
        for (tally, begun) in begun.chunks_exact(masks).enumerate() {
            let ahead = layer + (self.tally.after(tally, turn.to) << turn.near);
            if begun.iter().all(|begun| *begun == f64::INFINITY) {
                continue;
            }
            for (mask, (&begun, &next_mask)) in begun.iter().zip(next_masks).enumerate() {
                if turn.back as usize & mask == 0 {
                    each(begun, ahead + next_mask as usize);
                }
            }
        }
    }
}
