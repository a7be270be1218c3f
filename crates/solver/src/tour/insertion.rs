//! What it takes to put a candidate into a tour, or to go on with the rest of one.
//!
//! In constant time where segments concatenate, and for deadlines and time span wherever nothing
//! moves; elsewhere by forward simulation.

use super::{Run, Tour};
use crate::instance::Instance;

/// A place for a candidate in a tour, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Insertion {
    /// The stop goes before the one that is now here.
    pub position: usize,
    /// What the tour grows by in the scarce resource ([`crate::instance::Effort`]).
    pub effort: f64,
}

impl Tour {
    /// The end of the tour that comes from `run` and goes on with the stops from `position`; `None` if
    /// that breaks a limit.
    pub fn resume(&self, instance: &Instance<'_>, run: &Run, position: usize) -> Option<Run> {
        if instance.segments && !instance.untimed {
            let end = self.rest(position).after(instance, run)?;
            return (instance.energy_j(&end) <= instance.capacity_j).then_some(end);
        }
        let mut run = *run;
        for &candidate in &self.order()[position..] {
            run = instance.step(&run, candidate);
            if !instance.in_time(&run) {
                return None;
            }
        }
        let end = instance.finish(&run);
        instance.keeps_limits(&end).then_some(end)
    }

    /// The end of the tour in which `stops` stand in place of as many from position `from` on; `None` if
    /// that breaks a limit.
    pub fn rearranged(&self, instance: &Instance<'_>, from: usize, stops: &[u32]) -> Option<Run> {
        let until = from + stops.len();
        if instance.untimed {
            let edges = |stops: &[u32]| {
                let mut here = self.place_before(instance, from);
                let mut metres = 0.0;
                for &next in stops {
                    metres += instance.distance_m(here, next as usize);
                    here = next as usize;
                }
                metres + instance.distance_m(here, self.place(instance, until))
            };
            let metres = edges(stops) - edges(&self.order()[from..until]);
            let mut end = *self.finished();
            end.distance_m += metres;
            end.arrive_s += metres * instance.travel_spm;
            return instance.keeps_limits(&end).then_some(end);
        }
        let mut run = *self.before(from);
        for &next in stops {
            run = instance.step(&run, next);
            if !instance.in_time(&run) {
                return None;
            }
        }
        self.resume(instance, &run, until)
    }

    /// What it takes to put a candidate before `position`; `None` if that breaks a limit.
    pub fn insertion(
        &self,
        instance: &Instance<'_>,
        position: usize,
        candidate: u32,
    ) -> Option<Insertion> {
        if instance.untimed {
            let metres = self.detour_m(instance, position, candidate);
            let effort = self.effort_of_detour(instance, candidate, metres)?;
            return Some(Insertion { position, effort });
        }
        let (metres, seconds, joules) = if instance.moving {
            let run = instance.step(self.before(position), candidate);
            if !instance.in_time(&run) {
                return None;
            }
            let (end, now) = (self.resume(instance, &run, position)?, self.finished());
            let joules = end.charge_j - now.charge_j;
            (end.distance_m - now.distance_m, end.arrive_s - now.arrive_s, joules)
        } else {
            self.delayed(instance, position, candidate)?
        };
        Some(Insertion { position, effort: effort(instance, metres, seconds, joules) })
    }

    /// [`Tour::insertion`], if it takes less than `most`. Where metres alone count, times are looked at only
    /// for those.
    #[inline]
    pub fn insertion_below(
        &self,
        instance: &Instance<'_>,
        position: usize,
        candidate: u32,
        most: f64,
    ) -> Option<Insertion> {
        let per = &instance.effort;
        if per.per_s == 0.0
            && per.per_j == 0.0
            && !instance.moving
            && per.per_m * self.detour_m(instance, position, candidate) >= most
        {
            return None;
        }
        self.insertion(instance, position, candidate).filter(|new| new.effort < most)
    }

    /// Metres by which a candidate lengthens the way.
    #[inline]
    pub(crate) fn detour_m(&self, instance: &Instance<'_>, position: usize, candidate: u32) -> f64 {
        let (from, to) = (self.place_before(instance, position), self.place(instance, position));
        let via = candidate as usize;
        instance.distance_m(from, via) + instance.distance_m(via, to)
            - instance.distance_m(from, to)
    }

    /// What it takes to charge a candidate on a way that is so many metres longer; `None` if that breaks a limit. Only
    /// where totals decide.
    #[inline]
    pub(crate) fn effort_of_detour(
        &self,
        instance: &Instance<'_>,
        candidate: u32,
        metres: f64,
    ) -> Option<f64> {
        let charger = &instance.scenario.charger;
        let joules = instance.candidates[candidate as usize].charge_j(0.0);
        let seconds = metres * instance.travel_spm + joules * instance.transfer_spj;
        let now = self.finished();
        let energy_j = instance.energy_j(now) + charger.travel_jpm * metres + joules;
        let legal =
            now.arrive_s + seconds <= instance.timespan_s && energy_j <= instance.capacity_j;
        legal.then(|| effort(instance, metres, seconds, joules))
    }

    /// Metres, seconds and joules more where nothing moves: the seconds by which the next stop is delayed.
    fn delayed(
        &self,
        instance: &Instance<'_>,
        position: usize,
        candidate: u32,
    ) -> Option<(f64, f64, f64)> {
        let before = self.before(position);
        let run = instance.step(before, candidate);
        if !instance.in_time(&run) {
            return None;
        }
        let next = self.place(instance, position);
        let leg_m = instance.distance_m(candidate as usize, next);
        let reach_s = run.depart_s + leg_m * instance.travel_spm;
        if reach_s > self.latest(position) {
            return None;
        }
        if instance.capacity_j.is_finite() {
            self.resume(instance, &run, position)?;
        }
        let metres = self.detour_m(instance, position, candidate);
        Some((metres, reach_s - self.arrive_s(position), run.charge_j - before.charge_j))
    }

    /// Positions before which a candidate can be put in time at all: the charger leaves those behind them too late.
    /// Not where totals decide.
    pub fn in_time_until(&self, instance: &Instance<'_>, candidate: u32) -> usize {
        let due_s = instance.candidates[candidate as usize].due_s;
        (0..=self.len()).take_while(|&p| self.before(p).depart_s <= due_s).count()
    }

    /// The cheapest legal place of a candidate of those that `overlooked` does not hold for, asked where one is cheaper
    /// than those before it. Only where totals decide: there a longer way is never legal where a shorter one is not.
    pub fn shortest(
        &self,
        instance: &Instance<'_>,
        candidate: u32,
        mut overlooked: impl FnMut() -> bool,
    ) -> Option<Insertion> {
        if !self.has_room(instance, candidate) {
            return None;
        }
        let via = candidate as usize;
        // Most time of a search is spent here: what can be looked up once is.
        let position = match instance.travel.row_m(via) {
            Some(row_m) => self.least_detour(instance, via, |to| row_m[to], &mut overlooked),
            None => {
                let on_m = |to| instance.distance_m(via, to);
                self.least_detour(instance, via, on_m, &mut overlooked)
            }
        };
        self.insertion(instance, position?, candidate)
    }

    /// Whether a candidate could be charged if the way to it took nothing; only known where totals decide, else taken
    /// to be so.
    #[inline]
    pub(crate) fn has_room(&self, instance: &Instance<'_>, candidate: u32) -> bool {
        // Over it the way may be shorter where distances break the triangle inequality.
        let known = instance.untimed && instance.metric;
        !known || self.effort_of_detour(instance, candidate, 0.0).is_some()
    }

    #[inline]
    fn least_detour(
        &self,
        instance: &Instance<'_>,
        via: usize,
        on_m: impl Fn(usize) -> f64,
        overlooked: &mut impl FnMut() -> bool,
    ) -> Option<usize> {
        let (mut best, mut least_m) = (None, f64::INFINITY);
        let mut into_m = instance.distance_m(instance.start(), via);
        let places = self.order().iter().map(|&to| to as usize).chain([instance.end()]);
        for (position, (to, &leg_m)) in places.zip(self.legs_m()).enumerate() {
            let on_m = on_m(to);
            let metres = into_m + on_m - leg_m;
            if metres < least_m && !overlooked() {
                (best, least_m) = (Some(position), metres);
            }
            into_m = if instance.symmetric { on_m } else { instance.distance_m(to, via) };
        }
        best
    }

    /// The cheapest legal place of a candidate among all, the first among equals.
    pub fn cheapest(&self, instance: &Instance<'_>, candidate: u32) -> Option<Insertion> {
        if instance.untimed {
            return self.shortest(instance, candidate, || false);
        }
        let mut best: Option<Insertion> = None;
        for position in 0..self.in_time_until(instance, candidate) {
            let most = best.map_or(f64::INFINITY, |best| best.effort);
            best = self.insertion_below(instance, position, candidate, most).or(best);
        }
        best
    }
}

/// What an insertion takes of the scarce resource.
#[inline]
fn effort(instance: &Instance<'_>, metres: f64, seconds: f64, joules: f64) -> f64 {
    let per = &instance.effort;
    // Being early where one waits anyway gains nothing.
    let seconds = if instance.waits { seconds.max(0.0) } else { seconds };
    per.per_m * metres + per.per_s * seconds + per.per_j * joules
}
