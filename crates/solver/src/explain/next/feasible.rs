//! The least change that makes an infeasible scenario feasible, by bisection over decisions.

use super::super::change::{Buys, NextChange};
use super::super::ground::{Answer, Part, decide_all};
use super::super::meter::Meter;
use super::super::planning::order_of;
use super::Lever;
use crate::coverage::Demand;
use crate::scenario::{Place, Request, Scenario};

/// Decisions for one lever.
const DECISIONS: usize = 16;
/// A gap of this share of the value is close enough.
const CLOSE: f64 = 0.01;
/// A tour often needs the least there is: so much less is asked for first.
const JUST_BELOW: f64 = 0.001;
/// Iterations for one decision.
const DECISION: u64 = 100_000;
/// Deadlines that are tried where no conflict says which matter.
const DEADLINES: usize = 8;

/// For each lever that may help by itself the least change known to do.
///
/// A change helps only if it touches the conflict, for the rest of the scenario is innocent of it; the speed
/// touches all but conflicts of energy alone.
pub(in super::super) fn feasible(
    scenario: &Scenario,
    covers: &[Demand],
    conflict: Option<&[Part]>,
    suspects: &[usize],
    seed: u64,
    meter: &mut Meter<'_>,
) -> Vec<NextChange> {
    let levers = levers(scenario, conflict, suspects);
    let found = levers
        .into_iter()
        .filter_map(|lever| least(scenario, covers, lever, conflict.is_some(), seed, meter));
    found.collect()
}

fn levers(scenario: &Scenario, conflict: Option<&[Part]>, suspects: &[usize]) -> Vec<Lever> {
    let Some(parts) = conflict else {
        let due = suspects.iter().filter(|&&r| scenario.requests[r].deadline_s.is_some());
        let due = due.take(DEADLINES).map(|&request| Lever::Deadline(request));
        let limits = [Lever::Capacity, Lever::Timespan, Lever::Speed].into_iter();
        return limits.filter(|lever| lever.now(scenario).is_some()).chain(due).collect();
    };
    let lever = |part: &Part| match *part {
        Part::Capacity => Some(Lever::Capacity),
        Part::Timespan => Some(Lever::Timespan),
        Part::Deadline(request) => Some(Lever::Deadline(request)),
        Part::Cover(_) | Part::Required(_) => None,
    };
    let mut levers: Vec<Lever> = parts.iter().filter_map(lever).collect();
    let moves = |r: &Request| matches!(scenario.sensors[r.sensor].place, Place::Moving(_));
    // Speed saves no metres, but what drains less until it is reached takes less energy.
    let helps = levers.iter().any(|&lever| lever != Lever::Capacity)
        || scenario.requests.iter().any(|r| r.drain_w > 0.0 || moves(r));
    if helps {
        levers.push(Lever::Speed);
    }
    levers
}

/// The least value of one lever.
fn least(
    scenario: &Scenario,
    covers: &[Demand],
    lever: Lever,
    infeasible_now: bool,
    seed: u64,
    meter: &mut Meter<'_>,
) -> Option<NextChange> {
    let (mut order, mut sure) = opens(&lever.free(scenario), covers, seed, meter)?;
    let now = lever.now(scenario)?;
    let Some(mut enough) = lever.need(scenario, &order) else {
        meter.cut();
        return None;
    };
    let mut too_little = now;
    sure &= infeasible_now && lever.is_monotone(scenario);
    let mut fresh = true;
    for _ in 0..DECISIONS {
        let close = if fresh { JUST_BELOW } else { CLOSE };
        if !sure || enough - too_little <= close * enough {
            break;
        }
        let ask = if fresh { enough * (1.0 - JUST_BELOW) } else { 0.5 * (too_little + enough) };
        match decide_all(&lever.set(scenario, ask), covers, DECISION, meter) {
            Answer::Feasible(found) => {
                enough = lever.need(scenario, &found).map_or(ask, |need| need.min(ask));
                order = found;
                // Where a little less did, the next tour is looked for in the middle.
                fresh = !fresh;
            }
            Answer::Infeasible => {
                too_little = ask;
                fresh = false;
            }
            Answer::Unknown => {
                meter.cut();
                sure = false;
            }
        }
    }
    let proven = sure && enough - too_little <= CLOSE * enough;
    let Some(found) = lever.suggest(scenario, enough, &order, |_| Some(Buys::Feasible)) else {
        meter.cut();
        return None;
    };
    Some(NextChange { too_little: infeasible_now.then_some(too_little), proven, ..found })
}

/// A tour of a scenario, as requests, and whether the decision itself found it; `None` where none was found.
fn opens(
    scenario: &Scenario,
    covers: &[Demand],
    seed: u64,
    meter: &mut Meter<'_>,
) -> Option<(Vec<usize>, bool)> {
    match decide_all(scenario, covers, DECISION, meter) {
        Answer::Feasible(order) => Some((order, true)),
        Answer::Infeasible => None,
        // The bisection would not get an answer either; but a tour that does is worth knowing.
        Answer::Unknown => {
            meter.cut();
            order_of(scenario, seed, meter).map(|order| (order, false))
        }
    }
}
