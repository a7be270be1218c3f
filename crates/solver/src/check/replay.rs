//! Drives a tour again, stop by stop.

use crate::scenario::{Place, Point, Scenario};

use super::motion::{Departure, Meeting, meet};

/// A charge as it happens.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub(super) request: usize,
    pub(super) place: Point,
    pub(super) arrive_s: f64,
    pub(super) depart_s: f64,
    pub(super) charge_j: f64,
}

/// A whole trip: start, stops, end.
#[derive(Clone, Debug)]
pub(super) struct Replay {
    pub(super) visits: Vec<Visit>,
    pub(super) distance_m: f64,
    pub(super) travel_j: f64,
    pub(super) charge_j: f64,
    pub(super) finish_s: f64,
}

/// Row and column of start and end in the matrix of distances; requests follow.
const START: usize = 0;
const END: usize = 1;
const FIRST_REQUEST: usize = 2;

impl Replay {
    /// The trip that serves the requests of these indices in this order.
    pub(super) fn of(scenario: &Scenario, order: &[usize]) -> Self {
        let charger = &scenario.charger;
        let mut visits = Vec::with_capacity(order.len());
        let (mut node, mut place, mut now_s) = (START, charger.start_m, 0.0);
        let (mut distance_m, mut charge_j) = (0.0, 0.0);
        for &request in order {
            let meeting = go(scenario, node, place, now_s, request);
            let visit = charge(scenario, request, meeting);
            distance_m += meeting.distance_m;
            charge_j += visit.charge_j;
            (node, place, now_s) = (FIRST_REQUEST + request, visit.place, visit.depart_s);
            visits.push(visit);
        }
        let home_m = match &scenario.travel {
            Some(matrix) => matrix.get(node, END),
            None => (charger.end_m - place).norm(),
        };
        distance_m += home_m;
        Self {
            visits,
            distance_m,
            travel_j: charger.travel_jpm * distance_m,
            charge_j,
            finish_s: now_s + home_m / charger.speed_mps,
        }
    }

    /// All the energy that the trip takes.
    pub(super) fn energy_j(&self) -> f64 {
        self.charge_j + self.travel_j
    }
}

fn go(scenario: &Scenario, node: usize, from: Point, leave_s: f64, request: usize) -> Meeting {
    let asked = &scenario.requests[request];
    let speed_mps = scenario.charger.speed_mps;
    let target = &scenario.sensors[asked.sensor].place;
    match (&scenario.travel, target) {
        (Some(matrix), Place::Fixed(place)) => {
            let distance_m = matrix.get(node, FIRST_REQUEST + request);
            let at_s = (leave_s + distance_m / speed_mps).max(asked.ready_s);
            Meeting { at_s, place: *place, distance_m }
        }
        _ => meet(target, Departure { from, leave_s, ready_s: asked.ready_s, speed_mps }),
    }
}

fn charge(scenario: &Scenario, request: usize, meeting: Meeting) -> Visit {
    let asked = &scenario.requests[request];
    let full_j = scenario.charge_level * scenario.sensors[asked.sensor].battery_j;
    let left_j = (asked.residual_j - asked.drain_w * meeting.at_s).max(0.0);
    let charge_j = (full_j - left_j).max(0.0);
    Visit {
        request,
        place: meeting.place,
        arrive_s: meeting.at_s,
        depart_s: meeting.at_s + charge_j / scenario.charger.transfer_w,
        charge_j,
    }
}
