//! A shorter tour: the scenario planned again without one of the limits that the present tour stands close to.
//!
//! Sufficient, not proven minimal: less may do for a part of the gain.

use super::super::change::{Buys, NextChange};
use super::super::meter::Meter;
use super::super::planning::{plan_of, requests};
use super::Lever;
use crate::plan::Plan;
use crate::scenario::Scenario;

/// Deadlines that are tried, those with the least slack first.
const DEADLINES: usize = 8;
/// Changes that are told.
const TOLD: usize = 3;
/// What saves less than this share of the length is not worth a change.
const WORTH: f64 = 1e-3;

/// The changes that shorten the tour most.
pub(in super::super) fn shorter(
    scenario: &Scenario,
    plan: &Plan,
    seed: u64,
    meter: &mut Meter<'_>,
) -> Vec<NextChange> {
    let limits = [Lever::Capacity, Lever::Timespan].into_iter();
    let limits = limits.filter(|lever| lever.now(scenario).is_some());
    let levers: Vec<Lever> = limits.chain(tight(scenario, plan)).collect();
    let without = levers.into_iter().filter_map(|lever| {
        let freed = plan_of(&lever.free(scenario), seed, meter)?;
        let order = requests(scenario, &freed);
        // A tour that needs no more than there is shows that the plan can be bettered, not what a change buys.
        let to = lever.need(scenario, &order)?;
        lever.suggest(scenario, to, &order, |new| {
            let (from_m, to_m) = (plan.distance_m, new.distance_m);
            (from_m - to_m > WORTH * from_m).then_some(Buys::Shorter { from_m, to_m })
        })
    });
    let mut found: Vec<NextChange> = without.collect();
    found.sort_by(|a, b| length(a).total_cmp(&length(b)));
    found.truncate(TOLD);
    found
}

fn length(change: &NextChange) -> f64 {
    match change.buys {
        Buys::Shorter { to_m, .. } => to_m,
        _ => f64::INFINITY,
    }
}

/// The deadlines of the stops, by slack.
fn tight(scenario: &Scenario, plan: &Plan) -> Vec<Lever> {
    let stops = requests(scenario, plan);
    let slack = |(&request, stop): (&usize, &crate::plan::Stop)| {
        let deadline_s = scenario.requests[request].deadline_s?;
        Some((deadline_s - stop.arrive_s, Lever::Deadline(request)))
    };
    let mut slacks: Vec<(f64, Lever)> = stops.iter().zip(&plan.stops).filter_map(slack).collect();
    slacks.sort_by(|a, b| a.0.total_cmp(&b.0));
    slacks.into_iter().take(DEADLINES).map(|(_, lever)| lever).collect()
}
