//! The best tour by a plain dynamic programme: for every set of served requests and the last of them,
//! the journeys that no other beats in time, length and energy at once. Independent of the solver, for sizes
//! at which trying every tour takes too long.

use std::collections::HashMap;

use voltour_solver::scenario::{Place, Scenario};

use crate::journey::Journey;
use crate::truth::{Need, candidates, cost};

/// Journeys of one set and last stop.
type Labels = Vec<Journey>;

/// The least cost of a feasible tour whose limits are strained up to `most`; `None` if there is none.
/// Tours longer than `most_m` are left out; only among straight ways may that be less than infinite.
/// Where sensors move, time alone must decide what is better: no capacity, and `max_count` or `max_reward`.
pub fn best(scenario: &Scenario, needs: &[Need], most: f64, most_m: f64) -> Option<f64> {
    let moving = scenario.sensors.iter().any(|s| matches!(s.place, Place::Moving(_)));
    let candidates = candidates(scenario);
    let mut least: Option<f64> = None;
    let mut offer = |at: &Journey, served: u64| {
        let home = at.home(scenario);
        if home.strain <= most && needs.iter().all(|need| need.is_met(served)) {
            let cost = cost(scenario, home.length_m, served);
            least = Some(least.map_or(cost, |least| least.min(cost)));
        }
    };
    let begin = Journey::begin(scenario);
    offer(&begin, 0);
    // All sets of one size, then of the next.
    let mut layer: HashMap<(u64, usize), Labels> = HashMap::new();
    layer.insert((0, 0), vec![begin]);
    while !layer.is_empty() {
        let mut next: HashMap<(u64, usize), Labels> = HashMap::new();
        for ((served, _), labels) in &layer {
            for &to in candidates.iter().filter(|&&to| served >> to & 1 == 0) {
                for at in labels {
                    let ahead = at.visit(scenario, to);
                    let open = ahead.strain <= most && ahead.is_affordable(scenario, most);
                    if open && ahead.home(scenario).length_m <= most_m {
                        let set = served | 1 << to;
                        keep(scenario, moving, next.entry((set, to)).or_default(), ahead);
                    }
                }
            }
        }
        for ((served, _), labels) in &next {
            labels.iter().for_each(|at| offer(at, *served));
        }
        layer = next;
    }
    least
}

/// Adds a journey unless another is as good, and drops those that it beats.
fn keep(scenario: &Scenario, moving: bool, labels: &mut Labels, new: Journey) {
    let beats = |a: &Journey, b: &Journey| {
        let spends =
            moving || a.length_m <= b.length_m && a.energy_j(scenario) <= b.energy_j(scenario);
        a.time_s <= b.time_s && spends
    };
    if !labels.iter().any(|old| beats(old, &new)) {
        labels.retain(|old| !beats(&new, old));
        labels.push(new);
    }
}
