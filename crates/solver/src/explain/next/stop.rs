//! One more stop: what the present tour with one insertion needs more than it has.
//!
//! Sufficient, not proven minimal: another tour may do with less.

use super::super::change::{Buys, NextChange};
use super::super::insertion::{Insertion, Present, cheapest};
use super::Lever;
use super::lever::gain;
use crate::instance::Instance;
use crate::plan::Plan;

/// Insertions for which the speed is looked for.
const TRIED: usize = 5;

/// For each lever the least change with which an insertion fits that does not fit now.
pub(in super::super) fn one_more(
    present: &Present<'_, '_>,
    plan: &Plan,
    tried: &[Insertion],
) -> Vec<NextChange> {
    let instance = present.instance;
    let worth: Vec<&Insertion> = (tried.iter())
        .filter(|i| !i.trip.is_legal(instance))
        .filter(|i| gain_of(present, i) > 0.0)
        .collect();
    let mut found = Vec::new();
    for kind in [Lever::Capacity, Lever::Timespan, Lever::Deadline(0)] {
        let same = |l: Lever| std::mem::discriminant(&l) == std::mem::discriminant(&kind);
        let needs = worth.iter().filter_map(|i| lacks(instance, i).map(|(l, more)| (l, more, *i)));
        let least = needs.filter(|(lever, ..)| same(*lever)).min_by(|a, b| a.1.total_cmp(&b.1));
        found.extend(least.and_then(|(lever, _, i)| suggest(present, plan, lever, i)));
    }
    found.extend(faster(present, plan, worth));
    found
}

/// The one lever that an insertion lacks, and how much of it.
fn lacks(instance: &Instance<'_>, insertion: &Insertion) -> Option<(Lever, f64)> {
    let trip = &insertion.trip;
    match (trip.over_capacity(instance), trip.over_timespan(instance), trip.late, trip.first_late) {
        (true, false, 0, _) => Some((Lever::Capacity, trip.energy_j)),
        (false, true, 0, _) => Some((Lever::Timespan, trip.finish_s)),
        (false, false, 1, Some(late)) => {
            let request = instance.candidates[late.candidate as usize].request;
            Some((Lever::Deadline(request), late.arrive_s - late.deadline_s))
        }
        _ => None,
    }
}

/// Of the insertions of one candidate those that may be the least change for a lever: a few of many.
pub(in super::super) fn notable(
    instance: &Instance<'_>,
    insertions: &[Insertion],
) -> Vec<Insertion> {
    let least = |kind: Lever| {
        let same = |l: Lever| std::mem::discriminant(&l) == std::mem::discriminant(&kind);
        let needs =
            insertions.iter().filter_map(|i| lacks(instance, i).map(|(l, more)| (l, more, i)));
        needs.filter(|(l, ..)| same(*l)).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(.., i)| *i)
    };
    let kinds = [Lever::Capacity, Lever::Timespan, Lever::Deadline(0)];
    let all = kinds.into_iter().filter_map(least);
    all.chain(cheapest(instance, insertions).copied()).collect()
}

fn gain_of(present: &Present<'_, '_>, insertion: &Insertion) -> f64 {
    match present.instance.scenario.objective {
        crate::scenario::Objective::MaxCount => 1.0,
        _ => present.instance.candidates[insertion.candidate as usize].reward,
    }
}

/// The least speed among those of the insertions that break least.
fn faster(
    present: &Present<'_, '_>,
    plan: &Plan,
    mut worth: Vec<&Insertion>,
) -> Option<NextChange> {
    let at = |i: &Insertion| (i.candidate, i.position);
    worth.sort_by(|a, b| a.trip.excess.total_cmp(&b.trip.excess).then(at(a).cmp(&at(b))));
    worth.dedup_by_key(|i| at(i));
    let scenario = present.instance.scenario;
    let need = |i: &&Insertion| Lever::Speed.need(scenario, &requests(present, i));
    let needs = worth.iter().take(TRIED).filter_map(|i| need(i).map(|speed| (speed, *i)));
    let (_, insertion) = needs.min_by(|a, b| a.0.total_cmp(&b.0))?;
    suggest(present, plan, Lever::Speed, insertion)
}

fn requests(present: &Present<'_, '_>, insertion: &Insertion) -> Vec<usize> {
    let stops = present.with(insertion);
    stops.iter().map(|&c| present.instance.candidates[c as usize].request).collect()
}

fn suggest(
    present: &Present<'_, '_>,
    plan: &Plan,
    lever: Lever,
    insertion: &Insertion,
) -> Option<NextChange> {
    let scenario = present.instance.scenario;
    let order = requests(present, insertion);
    let to = lever.need(scenario, &order)?;
    let sensor = super::super::facts::sensor_id(present.instance, insertion.candidate);
    lever.suggest(scenario, to, &order, |new| {
        let (from, to) = (gain(scenario, plan), gain(scenario, new));
        (to > from).then_some(Buys::Stop { sensor, from, to })
    })
}
