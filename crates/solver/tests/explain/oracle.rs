//! Whether any order of any sensors keeps a list of clauses, by trying every one. Meant to be easy to read; it
//! shares nothing with the search for conflicts.

use voltour_solver::explain::Clause;
use voltour_solver::scenario::{Place, Point, Scenario};

/// Share of a limit within which the oracle gives no opinion.
const EDGE: f64 = 1e-5;

/// Whether a tour keeps the clauses; `None` where that hangs on rounding.
pub fn possible(scenario: &Scenario, clauses: &[Clause]) -> Option<bool> {
    let strictly = extend(scenario, clauses, -EDGE, &mut Vec::new());
    let loosely = extend(scenario, clauses, EDGE, &mut Vec::new());
    (strictly == loosely).then_some(strictly)
}

fn extend(scenario: &Scenario, clauses: &[Clause], slack: f64, order: &mut Vec<usize>) -> bool {
    if kept(scenario, clauses, slack, order) {
        return true;
    }
    for request in 0..scenario.requests.len() {
        if order.contains(&request) || scenario.already_charged(&scenario.requests[request]) {
            continue;
        }
        order.push(request);
        let found = extend(scenario, clauses, slack, order);
        order.pop();
        if found {
            return true;
        }
    }
    false
}

/// Whether a tour keeps every clause.
fn kept(scenario: &Scenario, clauses: &[Clause], slack: f64, order: &[usize]) -> bool {
    let trip = drive(scenario, order);
    let within = |value: f64, limit: f64| value <= limit + slack * limit.max(1.0);
    let request = |id: &String| {
        order.iter().position(|&r| scenario.sensors[scenario.requests[r].sensor].id == *id)
    };
    clauses.iter().all(|clause| match clause {
        Clause::Required { sensor } => request(sensor).is_some(),
        Clause::Demand { members, needs, .. } => {
            members.iter().filter(|id| request(id).is_some()).count() >= *needs as usize
        }
        Clause::Deadline { sensor, deadline_s } => {
            request(sensor).is_none_or(|stop| within(trip.arrivals[stop], *deadline_s))
        }
        Clause::Timespan { timespan_s } => within(trip.finish_s, *timespan_s),
        Clause::Capacity { capacity_j } => within(trip.energy_j, *capacity_j),
    })
}

struct Trip {
    arrivals: Vec<f64>,
    finish_s: f64,
    energy_j: f64,
}

fn drive(scenario: &Scenario, order: &[usize]) -> Trip {
    let charger = &scenario.charger;
    let (mut time, mut here, mut length, mut charged, mut row) =
        (0.0, charger.start_m, 0.0, 0.0, 0);
    let mut arrivals = Vec::new();
    for &r in order {
        let request = &scenario.requests[r];
        let place = &scenario.sensors[request.sensor].place;
        let leg =
            |to: Point| scenario.travel.as_ref().map_or((to - here).norm(), |t| t.get(row, r + 2));
        let reach = match place {
            Place::Fixed(point) => time + leg(*point) / charger.speed_mps,
            Place::Moving(_) => {
                let (mut low, mut high) = (time, time + 1e4);
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    let late =
                        (place.at(middle) - here).norm() > charger.speed_mps * (middle - time);
                    if late { low = middle } else { high = middle }
                }
                high
            }
        };
        let arrive = reach.max(request.ready_s);
        length += leg(place.at(arrive));
        let left = (request.residual_j - request.drain_w * arrive).max(0.0);
        let charge = (scenario.target_j(request) - left).max(0.0);
        charged += charge;
        (time, here, row) = (arrive + charge / charger.transfer_w, place.at(arrive), r + 2);
        arrivals.push(arrive);
    }
    let leg = scenario.travel.as_ref().map_or((charger.end_m - here).norm(), |t| t.get(row, 1));
    Trip {
        arrivals,
        finish_s: time + leg / charger.speed_mps,
        energy_j: charged + charger.travel_jpm * (length + leg),
    }
}
