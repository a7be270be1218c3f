//! Demands that a relaxed path must meet, rather than being paid for meeting them.
//!
//! A relaxed path that is paid for each member that it serves may skip a cluster where another path serves
//! more than is asked. Counting the members of some demands in the state rules that out: no path ends before it
//! has met them, and it gains nothing by going beyond.

use super::Model;

/// Which demands are counted, and how a visit changes the counts. All counts together are one number.
#[derive(Clone, Debug)]
pub struct Tally {
    /// The demands counted.
    pub demands: Vec<usize>,
    /// Number of combinations of counts; the last one meets them all.
    pub states: usize,
    /// By state and candidate, the state after a visit.
    after: Vec<u16>,
    candidates: usize,
    /// By demand counted, its members.
    members: Vec<Vec<u32>>,
    /// By demand counted, how many counts it has, from none to what it needs.
    sizes: Vec<usize>,
}

impl Tally {
    /// Counts these demands.
    pub fn new(model: &Model<'_>, demands: Vec<usize>) -> Self {
        let n = model.len();
        let sizes: Vec<usize> =
            demands.iter().map(|&d| model.demands[d].needs as usize + 1).collect();
        let states: usize = sizes.iter().product();
        let mut after = Vec::with_capacity(states * n);
        for state in 0..states {
            for candidate in 0..n as u32 {
                let (mut rest, mut unit, mut next) = (state, 1, 0);
                for (&d, &size) in demands.iter().zip(&sizes) {
                    let helps = model.demands[d].members.contains(&candidate);
                    let count = (rest % size + usize::from(helps)).min(size - 1);
                    next += unit * count;
                    rest /= size;
                    unit *= size;
                }
                after.push(next as u16);
            }
        }
        let members = demands.iter().map(|&d| model.demands[d].members.clone()).collect();
        Self { demands, states, after, candidates: n, members, sizes }
    }

    /// Closes the states, by interval, candidate and counts, in which more of a demand's members were visited
    /// than had been within reach by then, or fewer than those that will be can make up for.
    pub fn rule_out(&self, live: &mut [bool], intervals: usize) {
        let (n, states) = (self.candidates, self.states);
        let open = |b: usize, i: u32| {
            let place = (b * n + i as usize) * states;
            live[place..place + states].contains(&true)
        };
        let span = |&i: &u32| {
            let first = (0..intervals).find(|&b| open(b, i))?;
            Some((i, first, (0..intervals).rfind(|&b| open(b, i))?))
        };
        let spans = self.members.iter().map(|members| members.iter().filter_map(span).collect());
        let spans: Vec<Vec<(u32, usize, usize)>> = spans.collect();
        let mut unit = 1;
        for (spans, &size) in spans.iter().zip(&self.sizes) {
            for (place, live) in live.chunks_exact_mut(states).enumerate() {
                let (b, i) = (place / n, (place % n) as u32);
                let before = spans.iter().filter(|(_, first, _)| *first <= b).count();
                let after = spans.iter().filter(|(m, _, last)| *m != i && *last >= b).count();
                for (state, live) in live.iter_mut().enumerate() {
                    let count = state / unit % size;
                    *live &= count <= before && count + after + 1 >= size;
                }
            }
            unit *= size;
        }
    }

    /// The state after a visit.
    #[inline]
    pub fn after(&self, state: usize, candidate: u32) -> usize {
        // Mostly nothing is counted.
        if self.states == 1 {
            return 0;
        }
        self.after[state * self.candidates + candidate as usize] as usize
    }

    /// The state in which all are met.
    pub fn met(&self) -> usize {
        self.states - 1
    }
}
