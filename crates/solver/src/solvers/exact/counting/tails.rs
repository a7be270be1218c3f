//! The least time that going on takes, less the prizes of the stops that are made.

use super::timetable::{Hop, Timetable};

/// Values of going on from every interval and candidate, for given prizes.
#[derive(Debug)]
pub struct Tails<'t> {
    table: &'t Timetable,
    /// Seconds by which serving each candidate is worth delaying the end.
    prizes: Vec<f64>,
    /// By interval and candidate: seconds from the arrival there to the end, less the prizes of all later
    /// stops, at least.
    values: Vec<f64>,
}

impl<'t> Tails<'t> {
    pub fn new(table: &'t Timetable) -> Self {
        let values = vec![f64::INFINITY; table.intervals * table.n];
        Self { table, prizes: vec![0.0; table.n], values }
    }

    /// Values for other prizes, later intervals first.
    pub fn evaluate(&mut self, prizes: &[f64]) {
        self.prizes.copy_from_slice(prizes);
        let (n, table) = (self.table.n, self.table);
        for b in (0..table.intervals).rev() {
            self.values[b * n..(b + 1) * n].copy_from_slice(table.ends(b));
            // No tour has more stops within an interval than there are candidates.
            for _pass in 0..n {
                let mut fell = false;
                for from in 0..n {
                    let before = self.values[b * n + from];
                    let mut best = before;
                    for (to, (&hop, prize)) in table.hops(b, from).iter().zip(prizes).enumerate() {
                        let way = f64::from(hop.least_s) - prize + self.ahead(hop, to);
                        best = if way < best { way } else { best };
                    }
                    self.values[b * n + from] = best;
                    fell |= best < before;
                }
                if !fell || !table.within(b) {
                    break;
                }
            }
        }
    }

    /// The least value at the end of a hop.
    #[inline]
    fn ahead(&self, hop: Hop, to: usize) -> f64 {
        let mut place = usize::from(hop.first) * self.table.n + to;
        let mut least = self.values[place];
        for _next in hop.first..hop.last {
            place += self.table.n;
            let value = self.values[place];
            least = if value < least { value } else { least };
        }
        least
    }

    /// Going on from an interval over a certain next stop.
    #[inline]
    pub fn through(&self, b: usize, from: usize, to: usize) -> f64 {
        let hop = self.table.hops(b, from)[to];
        f64::from(hop.least_s) - self.prizes[to] + self.ahead(hop, to)
    }

    /// Going on from a candidate at which one arrives at a certain moment.
    #[inline]
    pub fn after(&self, arrive_s: f64, candidate: usize) -> f64 {
        self.values[self.table.interval(arrive_s) * self.table.n + candidate]
    }

    /// The prize of a candidate.
    #[inline]
    pub fn prize(&self, candidate: usize) -> f64 {
        self.prizes[candidate]
    }

    /// The interval of a moment.
    #[inline]
    pub fn interval(&self, time_s: f64) -> usize {
        self.table.interval(time_s)
    }

    /// The least value of a path that is at each candidate first at the given moments, and the stops of one.
    pub fn path(&self, firsts_s: &[f64]) -> (f64, Vec<u32>) {
        let n = self.table.n;
        let values = (0..n)
            .filter(|&to| firsts_s[to].is_finite())
            .map(|to| (firsts_s[to] - self.prizes[to] + self.after(firsts_s[to], to), to));
        let Some((value, mut at)) = values.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return (f64::INFINITY, Vec::new());
        };
        let mut stops = Vec::new();
        if value == f64::INFINITY {
            return (value, stops);
        }
        let mut b = self.interval(firsts_s[at]);
        // A path within an interval could go round; long ones are cut, as they only tell where to climb.
        while stops.len() < 4 * n {
            stops.push(at as u32);
            let ways = (0..n).map(|to| (self.through(b, at, to), to));
            let Some((way, to)) = ways.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            if way >= self.table.ends(b)[at] {
                break;
            }
            let hop = self.table.hops(b, at)[to];
            let value = |next: u16| self.values[usize::from(next) * n + to];
            let next = (hop.first..=hop.last).min_by(|&x, &y| value(x).total_cmp(&value(y)));
            (b, at) = (next.map_or(b, usize::from), to);
        }
        (value, stops)
    }
}
