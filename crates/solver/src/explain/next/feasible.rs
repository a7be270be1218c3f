//! The least change that makes an infeasible scenario feasible, by bisection over decisions.

use super::super::explanation::{Buys, NextChange};
use super::super::ground::{Answer, Part, decide_all};
use super::super::meter::Meter;
use super::super::planning::order_of;
use super::Lever;
use crate::coverage::Demand;
use crate::scenario::{Place, Scenario};

/// Halvings of the gap between what does and what does not.
const HALVINGS: usize = 12;
/// A gap of this share of the value is close enough.
const CLOSE: f64 = 0.01;
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
    let moves =
        |r: &crate::scenario::Request| matches!(scenario.sensors[r.sensor].place, Place::Moving(_));
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
    let mut enough = lever.need(scenario, &order)?;
    let mut too_little = lever.now(scenario)?;
    sure &= infeasible_now && lever.is_monotone(scenario);
    for _ in 0..HALVINGS {
        if !sure || enough - too_little <= CLOSE * enough {
            break;
        }
        let middle = 0.5 * (too_little + enough);
        match decide_all(&lever.set(scenario, middle), covers, DECISION, meter) {
            Answer::Feasible(found) => {
                enough = lever.need(scenario, &found).map_or(middle, |need| need.min(middle));
                order = found;
            }
            Answer::Infeasible => too_little = middle,
            Answer::Unknown => sure = false,
        }
    }
    let proven = sure && enough - too_little <= CLOSE * enough;
    let suggestion = lever.suggest(scenario, enough, &order, |_| Some(Buys::Feasible))?;
    let too_little = infeasible_now.then_some(too_little);
    Some(NextChange { too_little, proven, ..suggestion })
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
        Answer::Unknown => order_of(scenario, seed, meter).map(|order| (order, false)),
    }
}
