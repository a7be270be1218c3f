//! Reduced cost fixing: arcs that no path uses whose cost beats the cutoff are closed for good.

use super::relaxation::{CLOSED, Reading, Relaxation, Resource};

impl Relaxation<'_> {
    /// Closes, in every interval, the arcs over which the least cost of a path is `most` or more. The
    /// values must be those of these prizes.
    pub fn fix(&mut self, prizes: &[f64], most: f64) {
        let network = self.network;
        let (n, arcs, total) = (prizes.len(), network.arcs.len(), self.offset[prizes.len()]);
        let mut reached = vec![f64::INFINITY; self.intervals * total];
        for (a, &b) in network.leaving(n).zip(&self.starts) {
            let to = network.arcs[a].to;
            let state = self.states(b as usize, to, self.tally.after(0, to));
            reached[state] = network.arcs[a].cost - prizes[to as usize];
        }
        for b in 0..self.intervals {
            // A path is rounded down at every stop: a tour may be later than its path, never earlier.
            if b > 0 && self.reading == Reading::Tours && self.resource != Resource::Stops {
                for state in 0..total {
                    let before = reached[(b - 1) * total + state];
                    let value = &mut reached[b * total + state];
                    *value = value.min(before);
                }
            }
            // Paths that stay within an interval are followed until none of them gets cheaper.
            for _pass in 0..n.max(1) {
                let mut again = false;
                for i in 0..n {
                    again |= self.push(prizes, most, b, i, &mut reached);
                }
                if !again {
                    break;
                }
            }
            for i in 0..n {
                let begun = &reached[b * total + self.offset[i]..b * total + self.offset[i + 1]];
                let values =
                    &self.value[b * total + self.offset[i]..b * total + self.offset[i + 1]];
                let masks = 1 << self.memory.of[i].len();
                let states = begun.chunks_exact(masks).zip(values.chunks_exact(masks));
                let place = (b * n + i) * self.tally.states;
                for (live, (begun, values)) in self.graph.live[place..].iter_mut().zip(states) {
                    *live &= begun.iter().zip(values).any(|(begun, value)| begun + value < most);
                }
                let begun: Vec<f64> = begun
                    .iter()
                    .zip(values)
                    .map(|(&begun, value)| if begun + value < most { begun } else { f64::INFINITY })
                    .collect();
                for a in network.leaving(i) {
                    if self.graph.arrives[b * arcs + a] == CLOSED {
                        continue;
                    }
                    let cost = network.arcs[a].cost - prizes[network.arcs[a].to as usize];
                    let mut least = f64::INFINITY;
                    self.over(b, i, a, |state, ahead| {
                        least = least.min(begun[state] + cost + self.value[ahead]);
                    });
                    if least >= most {
                        self.graph.arrives[b * arcs + a] = CLOSED;
                    }
                }
            }
        }
    }

    /// Every pair of states that an arc joins: the tail's among those of its candidate, the head's among all.
    fn over(&self, b: usize, i: usize, a: usize, mut pair: impl FnMut(usize, usize)) {
        let masks = 1 << self.memory.of[i].len();
        let to = self.network.arcs[a].to;
        let next = self.graph.arrives[b * self.network.arcs.len() + a] as usize;
        for tally in (0..self.tally.states).filter(|&tally| self.live(b, i)[tally]) {
            let ahead = self.states(next, to, self.tally.after(tally, to));
            for mask in (0..masks).filter(|mask| self.back[a] as usize & mask == 0) {
                pair(tally * masks + mask, ahead + self.next_mask[self.masks[a] + mask] as usize);
            }
        }
    }

    /// Carries the costs at a candidate over its arcs; whether a cost within the interval fell.
    fn push(&self, prizes: &[f64], most: f64, b: usize, i: usize, reached: &mut [f64]) -> bool {
        let network = self.network;
        let (arcs, total) = (network.arcs.len(), self.offset[prizes.len()]);
        let own = b * total + self.offset[i]..b * total + self.offset[i + 1];
        let open = |(begun, value): (&f64, &f64)| begun + value < most;
        if !reached[own.clone()].iter().zip(&self.value[own.clone()]).any(open) {
            return false;
        }
        let mut again = false;
        for a in network.leaving(i) {
            let next = self.graph.arrives[b * arcs + a];
            if next == CLOSED {
                continue;
            }
            let cost = network.arcs[a].cost - prizes[network.arcs[a].to as usize];
            self.over(b, i, a, |state, ahead| {
                let begun = reached[own.start + state];
                let through = begun + cost;
                if through < reached[ahead] && begun + self.value[own.start + state] < most {
                    reached[ahead] = through;
                    again |= next as usize == b;
                }
            });
        }
        again
    }
}
