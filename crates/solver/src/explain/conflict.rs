//! From constraints that no tour keeps to a few of them that contradict each other.
//!
//! What is asked first is what is answered fast and understood easily: the limits of the charger alone, one demand
//! with its deadlines, then the neighbourhoods of a demand that the plan misses, twice as large each time. The
//! first infeasible set is thinned by a deletion filter: away with whatever leaves the rest infeasible, half
//! of it at a time, then a quarter, at last one by one (in the manner of Zeller and Hildebrandt, "Simplifying
//! and isolating failure-inducing input", 2002; one pass is enough, for infeasibility is monotone).

use super::ground::{Answer, Ground, Part};
use super::meter::Meter;
use crate::plan::{Plan, Violation};
use crate::scenario::Point;

/// Neighbourhoods are grown around so many demands.
const ANCHORS: usize = 4;

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Search {
    /// These contradict each other; whether it is proven that none of them is idle.
    Conflict(Vec<Part>, bool),
    /// A tour that keeps every constraint, as requests.
    Tour(Vec<usize>),
    /// Neither was shown.
    Open,
}

/// Looks for a conflict.
pub(super) fn search(ground: &mut Ground<'_>, plan: &Plan, meter: &mut Meter<'_>) -> Search {
    let anchors = anchors(ground, plan);
    match contradicting(ground, &anchors, meter) {
        Search::Conflict(parts, _) => {
            let (parts, irreducible) = thin(ground, parts, anchors[0], meter);
            if !irreducible {
                meter.cut();
            }
            Search::Conflict(parts, irreducible)
        }
        other => other,
    }
}

/// Where the plan falls short; at least one place.
fn anchors(ground: &Ground<'_>, plan: &Plan) -> Vec<Point> {
    let place = |violation: &Violation| match violation {
        Violation::Coverage { at_m, .. } => Some(Point::from(*at_m)),
        Violation::Required { sensor } => {
            let sensor = ground.scenario.sensors.iter().find(|s| s.id == *sensor)?;
            Some(sensor.place.at(0.0))
        }
        _ => None,
    };
    let mut anchors: Vec<Point> = plan.violations.iter().filter_map(place).take(ANCHORS).collect();
    if anchors.is_empty() {
        anchors.push(ground.scenario.charger.start_m);
    }
    anchors
}

/// Some constraints that no tour keeps together, the local ones first.
fn contradicting(ground: &mut Ground<'_>, anchors: &[Point], meter: &mut Meter<'_>) -> Search {
    let none = ground.limits(&[]);
    if !none.is_empty() && ground.decide(&none, meter) == Answer::Infeasible {
        return Search::Conflict(none, false);
    }
    let mut demands = ground.demands();
    // The sort is stable, so that neighbours in the document stay neighbours.
    demands.sort_by_key(|&part| ground.members(part).len());
    for &demand in &demands {
        let parts = with_limits(ground, &[demand]);
        if ground.decide(&parts, meter) == Answer::Infeasible {
            return Search::Conflict(parts, false);
        }
    }
    let mut size = 2;
    while size < demands.len() {
        for &anchor in anchors {
            nearest_first(ground, &mut demands, anchor);
            let parts = with_limits(ground, &demands[..size]);
            if ground.decide(&parts, meter) == Answer::Infeasible {
                return Search::Conflict(parts, false);
            }
        }
        size *= 2;
    }
    let all = ground.parts();
    match ground.decide(&all, meter) {
        Answer::Infeasible => Search::Conflict(all, false),
        Answer::Feasible(order) => Search::Tour(order),
        Answer::Unknown => Search::Open,
    }
}

fn with_limits(ground: &Ground<'_>, demands: &[Part]) -> Vec<Part> {
    let mut parts = demands.to_vec();
    parts.extend(ground.limits(demands));
    parts
}

fn nearest_first(ground: &Ground<'_>, demands: &mut [Part], place: Point) {
    let away = |part: &Part| (ground.place(*part) - place).norm();
    demands.sort_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
}

/// Thins an infeasible set; whether every part of the rest was shown to be needed.
///
/// Far demands go first, so that a conflict stays in one place; then deadlines, then the limits of the charger.
fn thin(
    ground: &mut Ground<'_>,
    parts: Vec<Part>,
    place: Point,
    meter: &mut Meter<'_>,
) -> (Vec<Part>, bool) {
    let is_demand = |part: &Part| matches!(part, Part::Cover(_) | Part::Required(_));
    let (mut demands, limits): (Vec<Part>, Vec<Part>) = parts.into_iter().partition(is_demand);
    nearest_first(ground, &mut demands, place);
    demands.reverse();
    let mut kept: Vec<Part> = demands.into_iter().chain(limits).collect();
    let mut size = kept.len().next_power_of_two();
    let mut all_needed = true;
    while size > 1 {
        size /= 2;
        let mut at = 0;
        while at < kept.len() {
            let until = kept.len().min(at + size);
            let rest = without(ground, &kept, at, until);
            match ground.decide(&rest, meter) {
                Answer::Infeasible => kept = rest,
                answer => {
                    all_needed &= size > 1 || answer != Answer::Unknown;
                    at = until;
                }
            }
        }
    }
    // A lone constraint is needed: with none at all, going home at once is a tour.
    (kept, all_needed)
}

/// The parts without those from `from` to `until`, and without the deadlines of those who are then asked for
/// no more.
fn without(ground: &Ground<'_>, kept: &[Part], from: usize, until: usize) -> Vec<Part> {
    let rest: Vec<Part> = kept[..from].iter().chain(&kept[until..]).copied().collect();
    let matter = ground.limits(&rest);
    let needed = |part: &Part| !matches!(part, Part::Deadline(_)) || matter.contains(part);
    rest.into_iter().filter(needed).collect()
}
