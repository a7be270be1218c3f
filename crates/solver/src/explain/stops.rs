//! Why each request that is not a stop is none, and what would be without each stop.

use std::collections::HashMap;

use super::explanation::{CheapestInsertion, Short, WhyServed, WhyUnserved};
use super::facts::{Trip, alone, breaches, sensor_id};
use super::insertion::{Insertion, Present, cheapest};
use super::meter::Meter;
use super::next;
use crate::coverage::Demand;
use crate::plan::{Plan, Reason};
use crate::tour::Tour;

/// Each unserved request of the plan; and the insertions that the next change may come from.
pub(super) fn unserved(
    present: &mut Present<'_, '_>,
    plan: &Plan,
    meter: &mut Meter<'_>,
) -> (Vec<WhyUnserved>, Vec<Insertion>) {
    let instance = present.instance;
    let all = (0..instance.len() as u32).map(|c| (sensor_id(instance, c), c));
    let candidates: HashMap<String, u32> = all.collect();
    let mut tried = Vec::new();
    let mut why = Vec::with_capacity(plan.unserved.len());
    for request in &plan.unserved {
        let candidate = candidates
            .get(&request.sensor)
            .copied()
            .filter(|_| request.reason != Reason::AlreadyCharged);
        let insertions = candidate.and_then(|c| present.insertions(c, meter)).unwrap_or_default();
        let best = cheapest(instance, &insertions);
        why.push(WhyUnserved {
            sensor: request.sensor.clone(),
            reason: request.reason,
            alone: candidate.map(|c| alone(instance, c)),
            insertion: best.map(|best| insertion(present, best)),
        });
        tried.extend(next::notable(instance, &insertions));
    }
    (why, tried)
}

fn insertion(present: &Present<'_, '_>, best: &Insertion) -> CheapestInsertion {
    let (trip, now) = (&best.trip, &present.trip);
    let before = best.position.checked_sub(1).map(|at| present.order[at]);
    CheapestInsertion {
        after: before.map(|candidate| sensor_id(present.instance, candidate)),
        extra_m: trip.distance_m - now.distance_m,
        extra_s: trip.finish_s - now.finish_s,
        extra_j: trip.energy_j - now.energy_j,
        breaks: breaches(present.instance, &present.with(best)),
    }
}

/// Each stop of the present tour.
pub(super) fn served(present: &Present<'_, '_>, covers: &[Demand]) -> Vec<WhyServed> {
    let (instance, order) = (present.instance, &present.order);
    let tour = Tour::new(instance, order);
    let mut candidate_of = vec![u32::MAX; instance.scenario.requests.len()];
    for (i, candidate) in (0u32..).zip(&instance.candidates) {
        candidate_of[candidate.request] = i;
    }
    let has = |demand: &Demand| {
        let counts = demand.members.iter().filter(|&&r| tour.serves(candidate_of[r as usize]));
        counts.count() as u32
    };
    // A demand with covers to spare is no stop's merit alone.
    let tight: Vec<(&Demand, u32)> =
        covers.iter().map(|d| (d, has(d))).filter(|(d, has)| *has <= d.needs).collect();
    let mut rest = order.clone();
    let stop = |(at, &candidate): (usize, &u32)| {
        rest.remove(at);
        let without = Trip::of(instance, &rest);
        let breaks = breaches(instance, &rest);
        rest.insert(at, candidate);
        let asked = &instance.candidates[candidate as usize];
        let counts = |d: &Demand| d.members.binary_search(&(asked.request as u32)).is_ok();
        WhyServed {
            sensor: sensor_id(instance, candidate),
            required: asked.required,
            short: tight
                .iter()
                .filter(|(d, _)| counts(d))
                .map(|&(d, has)| short(d, has - 1))
                .collect(),
            reward: asked.reward,
            saves_m: present.trip.distance_m - without.distance_m,
            saves_s: present.trip.finish_s - without.finish_s,
            saves_j: present.trip.energy_j - without.energy_j,
            breaks,
        }
    };
    order.iter().enumerate().map(stop).collect()
}

fn short(demand: &Demand, has: u32) -> Short {
    Short { at_m: [demand.witness.x, demand.witness.y], needs: demand.needs, has }
}
