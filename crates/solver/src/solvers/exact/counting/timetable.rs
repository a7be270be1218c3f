//! From each candidate to each other: how long it takes at least, by the interval in which one arrives.
//!
//! What is tabled holds for every moment of an interval, so that no rounding adds up along a path: a path
//! knows only the interval it is in, but takes as long as its hops.

use crate::instance::Instance;
use crate::scenario::Place;
use crate::solvers::Budget;
use crate::solvers::exact::network::stand;

/// A hop that cannot be made in time.
const CLOSED: Hop = Hop { least_s: f32::INFINITY, first: 0, last: 0 };
/// Rounding of single steps, in shares of the times that they add up.
const HAIR: f64 = 1e-9;

/// From the arrival at one candidate to the arrival at another: charging, travelling, waiting.
#[derive(Clone, Copy, Debug)]
pub struct Hop {
    /// It takes at least so many seconds.
    pub least_s: f32,
    /// The intervals in which one may arrive.
    pub first: u16,
    pub last: u16,
}

/// Hops and ways to the end from every candidate and interval.
#[derive(Debug)]
pub struct Timetable {
    /// Number of candidates.
    pub n: usize,
    /// Number of intervals, of equal width, up to the time span.
    pub intervals: usize,
    /// Seconds to intervals.
    per_s: f64,
    /// By interval, origin and destination.
    hops: Vec<Hop>,
    /// By interval and origin, seconds from the arrival there to the end of the tour, at least;
    /// infinite where the end is out of reach.
    ends: Vec<f64>,
    /// By interval, whether some hop may arrive in the interval that it leaves.
    within: Vec<bool>,
}

impl Timetable {
    /// Tables all hops; the time span must be finite. An iteration a candidate; `None` if the budget ends before.
    pub fn new(instance: &Instance<'_>, intervals: usize, budget: &mut Budget<'_>) -> Option<Self> {
        let n = instance.len();
        let width_s = instance.timespan_s.max(1e-9) / intervals as f64;
        let mut table = Self {
            n,
            intervals,
            per_s: 1.0 / width_s,
            hops: vec![CLOSED; intervals * n * n],
            ends: vec![f64::INFINITY; intervals * n],
            within: vec![false; intervals],
        };
        let speeds: Vec<f64> = (0..n).map(|i| most_mps(instance, i)).collect();
        for from in 0..n {
            if !budget.spend() {
                return None;
            }
            table.fill(instance, width_s, &speeds, from);
        }
        for (within, (b, hops)) in
            table.within.iter_mut().zip(table.hops.chunks_exact((n * n).max(1)).enumerate())
        {
            *within = hops.iter().any(|hop| hop.least_s.is_finite() && usize::from(hop.first) == b);
        }
        Some(table)
    }

    /// The interval of a moment.
    #[inline]
    pub fn interval(&self, time_s: f64) -> usize {
        ((time_s * self.per_s) as usize).min(self.intervals - 1)
    }

    /// The hops from a candidate, by destination.
    #[inline]
    pub fn hops(&self, b: usize, from: usize) -> &[Hop] {
        &self.hops[(b * self.n + from) * self.n..(b * self.n + from + 1) * self.n]
    }

    /// Seconds to the end of the tour, by origin.
    pub fn ends(&self, b: usize) -> &[f64] {
        &self.ends[b * self.n..(b + 1) * self.n]
    }

    /// Whether some hop may arrive in the interval that it leaves.
    pub fn within(&self, b: usize) -> bool {
        self.within[b]
    }

    fn fill(&mut self, instance: &Instance<'_>, width_s: f64, speeds_mps: &[f64], from: usize) {
        let (n, limit_s) = (self.n, instance.timespan_s);
        let charger_mps = instance.scenario.charger.speed_mps;
        let drift = drift(instance, from);
        let end_slope = drift + speeds_mps[from] / charger_mps;
        let slopes: Vec<f64> =
            (0..n).map(|to| slope(instance, speeds_mps, from, to, drift)).collect();
        let mut before: Vec<f64> = Vec::new();
        let mut now = Vec::with_capacity(n + 1);
        for edge in 0..=self.intervals {
            let time_s = edge as f64 * width_s;
            let run = stand(instance, from, time_s);
            now.clear();
            now.extend((0..n as u32).map(|to| instance.step(&run, to).arrive_s - time_s));
            now.push(instance.finish(&run).arrive_s - time_s);
            if edge > 0 {
                let (b, begin_s) = (edge - 1, (edge - 1) as f64 * width_s);
                let hair_s = HAIR * (1.0 + limit_s);
                // Nobody who arrives later goes on earlier, and no duration changes faster than its slope.
                let least = |i: usize, slope: f64| {
                    let (begin, end): (f64, f64) = (before[i], now[i]);
                    let middle = 0.5 * (begin + end - slope * width_s);
                    (middle.max(begin - width_s) - hair_s).max(0.0)
                };
                if begin_s + before[n] - hair_s <= limit_s {
                    self.ends[b * n + from] = least(n, end_slope);
                }
                for to in (0..n).filter(|&to| to != from) {
                    let (first_s, last_s) = (begin_s + before[to], time_s + now[to]);
                    let due_s = instance.candidates[to].due_s.min(limit_s);
                    if first_s - hair_s <= due_s {
                        self.hops[(b * n + from) * n + to] = Hop {
                            least_s: rounded_down(least(to, slopes[to])),
                            first: self.interval(first_s - hair_s).max(b) as u16,
                            last: self.interval(last_s + hair_s).max(b) as u16,
                        };
                    }
                }
            }
            std::mem::swap(&mut before, &mut now);
        }
    }
}

/// Seconds by which charging takes longer for each second that one arrives later, at most.
fn drift(instance: &Instance<'_>, candidate: usize) -> f64 {
    instance.candidates[candidate].drain_w / instance.scenario.charger.transfer_w
}

/// By how much a hop's duration changes at most for each second that one arrives later. The charger leaves
/// from where it met a sensor that has moved since, for one that moves too; it gains on that by the
/// difference of their speeds.
fn slope(instance: &Instance<'_>, speeds_mps: &[f64], from: usize, to: usize, drift: f64) -> f64 {
    let gains_mps = instance.scenario.charger.speed_mps - speeds_mps[to];
    let apart_mps = speeds_mps[from] + (1.0 + drift) * speeds_mps[to];
    let meeting = if gains_mps > 0.0 { drift + apart_mps / gains_mps } else { f64::INFINITY };
    // What is not ready is waited for.
    if instance.candidates[to].ready_s > 0.0 { meeting.max(1.0) } else { meeting }
}

/// The greatest speed of a candidate's sensor.
fn most_mps(instance: &Instance<'_>, candidate: usize) -> f64 {
    let sensor = instance.scenario.requests[instance.candidates[candidate].request].sensor;
    match &instance.scenario.sensors[sensor].place {
        Place::Fixed(_) => 0.0,
        Place::Moving(trajectory) => {
            let speeds = trajectory.waypoints().windows(2).map(|pair| {
                (pair[1].position_m - pair[0].position_m).norm() / (pair[1].time_s - pair[0].time_s)
            });
            speeds.fold(0.0, f64::max)
        }
    }
}

/// A single-precision number that is not greater; the time is not negative.
fn rounded_down(time_s: f64) -> f32 {
    ((time_s * (1.0 - 1e-6)) as f32).max(0.0)
}
