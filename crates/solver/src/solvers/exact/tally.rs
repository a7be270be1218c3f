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
        Self { demands, states, after, candidates: n }
    }

    /// The state after a visit.
    #[inline]
    pub fn after(&self, state: usize, candidate: u32) -> usize {
        self.after[state * self.candidates + candidate as usize] as usize
    }

    /// The state in which all are met.
    pub fn met(&self) -> usize {
        self.states - 1
    }
}
