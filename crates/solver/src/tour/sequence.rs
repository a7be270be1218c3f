//! [`Tour`]: the order, and for every position what comes before and what comes after.

use super::{Run, Segment};
use crate::instance::Instance;

const OUTSIDE: u32 = u32::MAX;

/// A place for a candidate in a tour, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Insertion {
    /// The stop goes before the one that is now here.
    pub position: usize,
    /// What the tour grows by in the scarce resource ([`crate::instance::Effort`]).
    pub effort: f64,
}

/// A sequence of candidates with its schedule. A tour may be illegal only where leaving a stop out may
/// break a limit (no triangle inequality); [`Tour::is_legal`] tells.
#[derive(Debug, Default)]
pub struct Tour {
    order: Vec<u32>,
    /// By candidate; `OUTSIDE` if it is not served.
    position: Vec<u32>,
    /// `runs[p]` is the charger before position `p`; one more than stops.
    runs: Vec<Run>,
    /// `suffix[p]` is the rest from position `p` on with the end; where segments concatenate.
    suffix: Vec<Segment>,
    /// `latest[p]`: getting to position `p` by then keeps every later deadline and the time span;
    /// where nothing moves.
    latest: Vec<f64>,
    finished: Option<Run>,
    legal: bool,
}

impl Clone for Tour {
    fn clone(&self) -> Self {
        let mut tour = Self::default();
        tour.clone_from(self);
        tour
    }

    fn clone_from(&mut self, source: &Self) {
        self.order.clone_from(&source.order);
        self.position.clone_from(&source.position);
        self.runs.clone_from(&source.runs);
        self.suffix.clone_from(&source.suffix);
        self.latest.clone_from(&source.latest);
        self.finished = source.finished;
        self.legal = source.legal;
    }
}

impl Tour {
    /// The tour with these stops.
    pub fn new(instance: &Instance<'_>, order: &[u32]) -> Self {
        let mut tour = Self { position: vec![OUTSIDE; instance.len()], ..Self::default() };
        tour.order.extend_from_slice(order);
        tour.refresh(instance, 0, order.len());
        tour
    }

    /// The stops in order.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Number of stops.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether it has no stop.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Where a candidate stands.
    pub fn position(&self, candidate: u32) -> Option<usize> {
        let position = self.position[candidate as usize];
        (position != OUTSIDE).then_some(position as usize)
    }

    /// Whether a candidate is a stop.
    pub fn serves(&self, candidate: u32) -> bool {
        self.position[candidate as usize] != OUTSIDE
    }

    /// The charger before a position; `before(len)` is after the last stop.
    pub fn before(&self, position: usize) -> &Run {
        &self.runs[position]
    }

    /// The charger at the end.
    pub fn finished(&self) -> Run {
        self.finished.unwrap_or(self.runs[self.order.len()])
    }

    /// Whether constraints 1 to 3 hold.
    pub fn is_legal(&self) -> bool {
        self.legal
    }

    /// Sum of the served rewards.
    pub fn reward(&self, instance: &Instance<'_>) -> f64 {
        self.order.iter().map(|&c| instance.candidates[c as usize].reward).sum()
    }

    /// The place at a position, the end behind the last.
    pub fn place(&self, instance: &Instance<'_>, position: usize) -> usize {
        self.order.get(position).map_or(instance.end(), |&c| c as usize)
    }

    /// Puts a candidate before the stop that is now at `position`.
    pub fn insert(&mut self, instance: &Instance<'_>, position: usize, candidate: u32) {
        self.order.insert(position, candidate);
        self.refresh(instance, position, position + 1);
    }

    /// Takes out every stop for which `leaves` holds.
    pub fn remove(&mut self, instance: &Instance<'_>, leaves: impl Fn(u32) -> bool) {
        let Some(first) = self.order.iter().position(|&c| leaves(c)) else { return };
        for &candidate in &self.order {
            if leaves(candidate) {
                self.position[candidate as usize] = OUTSIDE;
            }
        }
        self.order.retain(|&c| !leaves(c));
        self.refresh(instance, first, self.order.len());
    }

    /// Replaces the order between two positions by an order of the same stops.
    pub fn reorder(&mut self, instance: &Instance<'_>, from: usize, stops: &[u32]) {
        self.order[from..from + stops.len()].copy_from_slice(stops);
        self.refresh(instance, from, from + stops.len());
    }

    /// Replaces the whole order.
    pub fn replace(&mut self, instance: &Instance<'_>, order: &[u32]) {
        for &candidate in &self.order {
            self.position[candidate as usize] = OUTSIDE;
        }
        self.order.clear();
        self.order.extend_from_slice(order);
        self.refresh(instance, 0, order.len());
    }

    /// Recomputes the schedule from position `from` on, and the records of what comes after for every
    /// position before `to`.
    fn refresh(&mut self, instance: &Instance<'_>, from: usize, to: usize) {
        let stops = self.order.len();
        self.runs.truncate(from + 1);
        if self.runs.is_empty() {
            self.runs.push(instance.departure());
        }
        let mut run = self.runs[from];
        for (p, &candidate) in self.order.iter().enumerate().skip(from) {
            self.position[candidate as usize] = p as u32;
            run = instance.step(&run, candidate);
            self.runs.push(run);
        }
        let end = instance.finish(&run);
        self.finished = Some(end);
        let in_time = self.runs[1..].iter().all(|run| instance.in_time(run));
        self.legal = in_time && instance.keeps_limits(&end);
        self.refresh_after(instance, stops, to);
    }

    fn refresh_after(&mut self, instance: &Instance<'_>, stops: usize, to: usize) {
        if instance.moving {
            return;
        }
        // Records are kept from the back, so that an insertion leaves those behind it as they are.
        let kept = (stops - to).min(self.latest.len().saturating_sub(1));
        self.latest.truncate(kept + 1);
        if self.latest.is_empty() {
            self.latest.push(instance.timespan_s);
        }
        self.suffix.truncate(kept + 1);
        if instance.segments && self.suffix.is_empty() {
            self.suffix.push(Segment::end(instance));
        }
        for p in (0..stops - kept).rev() {
            let here = self.order[p];
            if instance.segments {
                let rest =
                    Segment::stop(instance, here).then(instance, &self.suffix[stops - p - 1]);
                self.suffix.push(rest);
                self.latest.push(rest.latest_s);
            } else {
                let next = self.place(instance, p + 1);
                self.latest.push(latest_start(instance, here, next, self.latest[stops - p - 1]));
            }
        }
    }

    /// Getting to `position` at this time keeps every later deadline and the time span; only where
    /// nothing moves.
    fn latest(&self, position: usize) -> f64 {
        self.latest[self.order.len() - position]
    }

    /// The end of the tour that comes from `run` and goes on with the stops from `position`; `None` if
    /// that breaks a limit.
    pub fn resume(&self, instance: &Instance<'_>, run: &Run, position: usize) -> Option<Run> {
        if instance.segments {
            let end = self.suffix[self.order.len() - position].after(instance, run)?;
            return (instance.energy_j(&end) <= instance.capacity_j).then_some(end);
        }
        let mut run = *run;
        for &candidate in &self.order[position..] {
            run = instance.step(&run, candidate);
            if !instance.in_time(&run) {
                return None;
            }
        }
        let end = instance.finish(&run);
        instance.keeps_limits(&end).then_some(end)
    }

    /// What it takes to put a candidate before `position`; `None` if that breaks a limit.
    pub fn insertion(
        &self,
        instance: &Instance<'_>,
        position: usize,
        candidate: u32,
    ) -> Option<Insertion> {
        let run = instance.step(&self.runs[position], candidate);
        if !instance.in_time(&run) {
            return None;
        }
        let effort = &instance.effort;
        let charge_j = run.charge_j - self.runs[position].charge_j;
        let (metres, seconds) = if instance.moving {
            let (end, now) = (self.resume(instance, &run, position)?, self.finished());
            (end.distance_m - now.distance_m, end.arrive_s - now.arrive_s)
        } else {
            let next = self.place(instance, position);
            let from = self.runs[position].node as usize;
            let leg_m = instance.distance_m(candidate as usize, next);
            let reach_s = run.depart_s + leg_m / instance.scenario.charger.speed_mps;
            if reach_s > self.latest(position) {
                return None;
            }
            if instance.capacity_j.is_finite() {
                self.resume(instance, &run, position)?;
            }
            let metres = run.distance_m - self.runs[position].distance_m + leg_m
                - instance.distance_m(from, next);
            let then = self.runs.get(position + 1).unwrap_or(self.finished.as_ref()?).arrive_s;
            (metres, reach_s - then)
        };
        let effort =
            effort.per_m * metres + effort.per_s * seconds.max(0.0) + effort.per_j * charge_j;
        Some(Insertion { position, effort })
    }

    /// The cheapest legal place of a candidate among all.
    pub fn cheapest(&self, instance: &Instance<'_>, candidate: u32) -> Option<Insertion> {
        let all = (0..=self.order.len()).filter_map(|p| self.insertion(instance, p, candidate));
        all.min_by(|a, b| a.effort.total_cmp(&b.effort))
    }
}

/// The latest moment to get to `here` if one must get to `next` by `limit_s`: the inverse of the
/// departure, which rises strictly with the arrival.
fn latest_start(instance: &Instance<'_>, here: u32, next: usize, limit_s: f64) -> f64 {
    let charger = &instance.scenario.charger;
    let candidate = &instance.candidates[here as usize];
    let leave_s = limit_s - instance.distance_m(here as usize, next) / charger.speed_mps;
    let needed_s = (candidate.target_j - candidate.residual_j) / charger.transfer_w;
    let draining = (leave_s - needed_s) / (1.0 + candidate.drain_w / charger.transfer_w);
    let begin = if draining <= candidate.empty_s() {
        draining
    } else {
        leave_s - candidate.target_j / charger.transfer_w
    };
    if begin < candidate.ready_s { f64::NEG_INFINITY } else { begin.min(candidate.due_s) }
}
