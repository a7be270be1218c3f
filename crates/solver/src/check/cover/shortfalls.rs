//! Where a tour leaves too few covers, and where there were too few from the start.

use std::collections::BTreeSet;

use crate::check::close::{Verdict, slack};
use crate::check::order::already_charged;
use crate::scenario::{Point, Scenario};

use super::disks::Disks;
use super::faces::{self, Sets, rounding};
use super::field::Field;

/// Covers of a sub-region: what is asked and what is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::check) struct Count {
    pub(in crate::check) needs: u32,
    pub(in crate::check) has: u32,
}

/// Which of the two lists of a plan is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::check) enum List {
    /// Sets that a tour leaves short.
    Violations,
    /// Sets that the deployment leaves below k.
    Warnings,
}

/// What is wrong with an entry of a list.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::check) enum Mismatch {
    /// There is no field, or the point is not in it.
    NotInField,
    /// The sub-region there is not short of covers.
    NotShort(Count),
    /// It is, in these numbers.
    Differs(Count),
    /// An earlier entry names the same covering set.
    Repeated,
}

/// The short covering sets of a scenario under a tour.
pub(in crate::check) struct Shortfalls<'a> {
    ground: Option<Ground<'a>>,
    /// Per sensor: whether the tour is as good without it (broken = surely).
    does_without: Vec<Verdict>,
}

struct Ground<'a> {
    disks: Disks,
    field: Field<'a>,
    tally: Tally,
    sets: Sets,
}

/// Counts covers.
struct Tally {
    k: u32,
    /// Per sensor: whether it asks, is a candidate, and is not served.
    lost: Vec<bool>,
}

impl Tally {
    fn of(scenario: &Scenario, k: u32, order: &[usize]) -> Self {
        let mut lost = vec![false; scenario.sensors.len()];
        for request in &scenario.requests {
            lost[request.sensor] = !already_charged(scenario, request);
        }
        for &served in order {
            lost[scenario.requests[served].sensor] = false;
        }
        Self { k, lost }
    }

    fn count(&self, list: List, set: &[u32]) -> Count {
        let covers = set.len() as u32;
        let lost = set.iter().filter(|sensor| self.lost[**sensor as usize]).count() as u32;
        match list {
            List::Violations => Count { needs: self.k.min(covers), has: covers - lost },
            List::Warnings => Count { needs: self.k, has: covers },
        }
    }

    fn is_short(&self, list: List, set: &[u32]) -> bool {
        let Count { needs, has } = self.count(list, set);
        has < needs
    }
}

impl<'a> Shortfalls<'a> {
    pub(in crate::check) fn of(scenario: &'a Scenario, order: &[usize]) -> Self {
        let mut does_without = vec![Verdict::Broken; scenario.sensors.len()];
        let ground = scenario.coverage.as_ref().map(|coverage| {
            let (disks, field) = faces::survey(scenario, coverage);
            let tally = Tally::of(scenario, coverage.k, order);
            let wanted = |set: &[u32]| {
                tally.is_short(List::Violations, set) || tally.is_short(List::Warnings, set)
            };
            let sets = faces::sets(&disks, &field, &wanted);
            Ground { disks, field, tally, sets }
        });
        for (set, witness) in ground.iter().flat_map(|ground| ground.short(List::Violations)) {
            let verdict = if witness.is_some() { Verdict::Kept } else { Verdict::Either };
            lower(&mut does_without, set, verdict);
        }
        Self { ground, does_without }
    }

    /// Whether serving a sensor would mend no shortfall: broken = surely it would not.
    pub(in crate::check) fn does_without(&self, sensor: usize) -> Verdict {
        self.does_without[sensor]
    }

    /// Whether any set is short: broken = surely.
    pub(in crate::check) fn verdict(&self) -> Verdict {
        let sets = self.ground.iter().flat_map(|ground| ground.short(List::Violations));
        let verdict = |(_, witness): (_, &Option<Point>)| match witness {
            Some(_) => Verdict::Broken,
            None => Verdict::Either,
        };
        sets.map(verdict).max().unwrap_or(Verdict::Kept)
    }

    /// The set that an entry of a list names, by evaluation at its point.
    pub(in crate::check) fn identify(
        &mut self,
        list: List,
        at: Point,
        count: Count,
        taken: &BTreeSet<Vec<u32>>,
    ) -> Result<Vec<u32>, Mismatch> {
        let ground = self.ground.as_ref().ok_or(Mismatch::NotInField)?;
        let set = ground.identify(list, at, count, taken)?;
        if list == List::Violations {
            // A set that the walk missed may still be there; then either reason will do.
            lower(&mut self.does_without, &set, Verdict::Either);
        }
        Ok(set)
    }

    /// The sets that a list must name, each with a witness and its count.
    pub(in crate::check) fn surely<'s>(
        &'s self,
        list: List,
    ) -> impl Iterator<Item = (&'s Vec<u32>, Point, Count)> {
        self.ground.iter().flat_map(move |ground| {
            let entry = |(set, witness): (&'s Vec<u32>, &Option<Point>)| {
                witness.map(|point| (set, point, ground.tally.count(list, set)))
            };
            ground.short(list).filter_map(entry).collect::<Vec<_>>()
        })
    }
}

impl Ground<'_> {
    fn short(&self, list: List) -> impl Iterator<Item = (&Vec<u32>, &Option<Point>)> {
        self.sets.iter().filter(move |(set, _)| self.tally.is_short(list, set))
    }

    fn identify(
        &self,
        list: List,
        at: Point,
        count: Count,
        taken: &BTreeSet<Vec<u32>>,
    ) -> Result<Vec<u32>, Mismatch> {
        if !self.field.contains(at) && !self.field.border_within(at, slack(0.0)) {
            return Err(Mismatch::NotInField);
        }
        let candidates = self.candidates(list, at);
        let short = |set: &&Vec<u32>| self.tally.is_short(list, set);
        let fits = |set: &&Vec<u32>| self.tally.count(list, set) == count;
        let mut fitting = candidates.iter().filter(short).filter(fits).peekable();
        if fitting.peek().is_some() {
            let free = fitting.find(|set| !taken.contains(*set));
            return free.cloned().ok_or(Mismatch::Repeated);
        }
        let there = |set: &Vec<u32>| self.tally.count(list, set);
        match (candidates.iter().find(short), candidates.first()) {
            (Some(set), _) => Err(Mismatch::Differs(there(set))),
            (None, Some(set)) => Err(Mismatch::NotShort(there(set))),
            (None, None) => {
                let exact = self.disks.at(at, |_| 0.0);
                Err(Mismatch::NotShort(there(&exact.surely)))
            }
        }
    }

    /// The sets that a point may stand for: the one that covers it, and where circles pass within
    /// the tolerance, those among the sets found that differ from it in these circles only.
    fn candidates(&self, list: List, at: Point) -> Vec<Vec<u32>> {
        let exact = self.disks.at(at, rounding(at));
        let mut candidates = Vec::new();
        if exact.perhaps.is_empty() {
            candidates.push(exact.surely);
        }
        let rough = self.disks.at(at, |disk| slack(disk.radius));
        if !rough.perhaps.is_empty() {
            let within = |set: &[u32]| {
                let member = |i: &u32| {
                    rough.surely.binary_search(i).is_ok() || rough.perhaps.binary_search(i).is_ok()
                };
                rough.surely.iter().all(|i| set.binary_search(i).is_ok()) && set.iter().all(member)
            };
            candidates
                .extend(self.short(list).map(|(set, _)| set.clone()).filter(|set| within(set)));
        }
        candidates
    }
}

fn lower(verdicts: &mut [Verdict], set: &[u32], to: Verdict) {
    for &sensor in set {
        let verdict = &mut verdicts[sensor as usize];
        *verdict = to.min(*verdict);
    }
}
