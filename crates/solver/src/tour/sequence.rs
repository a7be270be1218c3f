//! [`Tour`]: the order, and for every position what comes before and what comes after.

use super::{Run, Segment};
use crate::instance::Instance;

const OUTSIDE: u32 = u32::MAX;

/// A sequence of candidates with its schedule. A tour may be illegal only where leaving a stop out may
/// break a limit (no triangle inequality); [`Tour::is_legal`] tells.
#[derive(Debug)]
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
    /// `legs_m[p]`: the way to position `p`, the last one to the end; where totals decide.
    legs_m: Vec<f64>,
    finished: Run,
    legal: bool,
}

impl Clone for Tour {
    fn clone(&self) -> Self {
        Self {
            order: self.order.clone(),
            position: self.position.clone(),
            runs: self.runs.clone(),
            suffix: self.suffix.clone(),
            latest: self.latest.clone(),
            legs_m: self.legs_m.clone(),
            finished: self.finished,
            legal: self.legal,
        }
    }

    fn clone_from(&mut self, source: &Self) {
        self.order.clone_from(&source.order);
        self.position.clone_from(&source.position);
        self.runs.clone_from(&source.runs);
        self.suffix.clone_from(&source.suffix);
        self.latest.clone_from(&source.latest);
        self.legs_m.clone_from(&source.legs_m);
        self.finished = source.finished;
        self.legal = source.legal;
    }
}

impl Tour {
    /// The tour with these stops.
    pub fn new(instance: &Instance<'_>, order: &[u32]) -> Self {
        let mut tour = Self {
            order: order.to_vec(),
            position: vec![OUTSIDE; instance.len()],
            runs: Vec::new(),
            suffix: Vec::new(),
            latest: Vec::new(),
            legs_m: Vec::new(),
            finished: instance.departure(),
            legal: false,
        };
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

    /// The charger at the end.
    pub fn finished(&self) -> &Run {
        &self.finished
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
        for (p, &candidate) in self.order.iter().enumerate().skip(from) {
            self.position[candidate as usize] = p as u32;
        }
        if instance.untimed {
            self.total(instance);
            return;
        }
        self.runs.truncate(from + 1);
        if self.runs.is_empty() {
            self.runs.push(instance.departure());
        }
        let mut run = self.runs[from];
        self.runs.extend(self.order[from..].iter().map(|&candidate| {
            run = instance.step(&run, candidate);
            run
        }));
        let end = instance.finish(&run);
        self.finished = end;
        let in_time = self.runs[1..].iter().all(|run| instance.in_time(run));
        self.legal = in_time && instance.keeps_limits(&end);
        self.refresh_after(instance, to);
    }

    /// Where legality hangs on totals alone, these are all that is kept.
    fn total(&mut self, instance: &Instance<'_>) {
        let charger = &instance.scenario.charger;
        let (mut distance_m, mut charge_j, mut here) = (0.0, 0.0, instance.start());
        self.legs_m.clear();
        for &candidate in &self.order {
            self.legs_m.push(instance.distance_m(here, candidate as usize));
            distance_m += self.legs_m[self.legs_m.len() - 1];
            charge_j += instance.candidates[candidate as usize].charge_j(0.0);
            here = candidate as usize;
        }
        let last_m = instance.distance_m(here, instance.end());
        self.legs_m.push(last_m);
        distance_m += last_m;
        let arrive_s = distance_m * instance.travel_spm + charge_j * instance.transfer_spj;
        let end = Run {
            node: instance.end() as u32,
            place: charger.end_m,
            arrive_s,
            depart_s: arrive_s,
            distance_m,
            charge_j,
        };
        self.finished = end;
        self.legal = instance.keeps_limits(&end);
    }

    fn refresh_after(&mut self, instance: &Instance<'_>, to: usize) {
        if instance.moving {
            return;
        }
        let stops = self.order.len();
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

    /// The place before a position, the start before the first.
    pub fn place_before(&self, instance: &Instance<'_>, position: usize) -> usize {
        position.checked_sub(1).map_or(instance.start(), |p| self.order[p] as usize)
    }

    /// The charger before a position; `before(len)` is after the last stop. Not kept where the
    /// instance is untimed.
    pub(super) fn before(&self, position: usize) -> &Run {
        &self.runs[position]
    }

    /// The charger after the last stop, where that is kept.
    pub(super) fn after_last(&self) -> Option<&Run> {
        self.runs.last().filter(|_| self.runs.len() > self.order.len())
    }

    /// When charging begins at a position, the arrival at the end behind the last.
    pub(super) fn arrive_s(&self, position: usize) -> f64 {
        self.runs.get(position + 1).unwrap_or(&self.finished).arrive_s
    }

    /// The way to each position, in metres, and last to the end; only where totals decide.
    pub(super) fn legs_m(&self) -> &[f64] {
        &self.legs_m
    }

    /// The rest of the tour from `position` on; only where segments concatenate.
    pub(super) fn rest(&self, position: usize) -> &Segment {
        &self.suffix[self.order.len() - position]
    }

    /// Getting to `position` at this time keeps every later deadline and the time span; only where
    /// nothing moves.
    pub(super) fn latest(&self, position: usize) -> f64 {
        self.latest[self.order.len() - position]
    }
}

/// The latest moment to get to `here` if one must get to `next` by `limit_s`: the inverse of the
/// departure, which rises strictly with the arrival.
fn latest_start(instance: &Instance<'_>, here: u32, next: usize, limit_s: f64) -> f64 {
    let candidate = &instance.candidates[here as usize];
    let leave_s = limit_s - instance.distance_m(here as usize, next) * instance.travel_spm;
    let needed_s = (candidate.target_j - candidate.residual_j) * instance.transfer_spj;
    let draining = (leave_s - needed_s) / (1.0 + candidate.drain_w * instance.transfer_spj);
    let begin = if draining <= candidate.empty_s() {
        draining
    } else {
        leave_s - candidate.target_j * instance.transfer_spj
    };
    if begin < candidate.ready_s { f64::NEG_INFINITY } else { begin.min(candidate.due_s) }
}
