//! A charger's journey, step by step as `formats.md` tells it. It knows scenarios only, and nothing of
//! how solvers see them.

use voltour_solver::scenario::{Place, Point, Scenario};
use voltour_solver::tolerance::tolerance;

/// The charger when it leaves a place.
#[derive(Clone, Copy, Debug)]
pub struct Journey {
    /// Row of the place in a matrix of distances.
    row: usize,
    place: Point,
    /// When charging began here, in seconds.
    pub arrive_s: f64,
    /// When it leaves, in seconds.
    pub time_s: f64,
    /// Travelled so far, in metres.
    pub length_m: f64,
    /// Delivered so far, in joules.
    pub charged_j: f64,
    /// By how many tolerances a limit was exceeded, at most. The check accepts 1, a solver keeps to 0.5.
    pub strain: f64,
}

impl Journey {
    /// At the start, at time 0.
    pub fn begin(scenario: &Scenario) -> Self {
        Self {
            row: 0,
            place: scenario.charger.start_m,
            arrive_s: 0.0,
            time_s: 0.0,
            length_m: 0.0,
            charged_j: 0.0,
            strain: f64::NEG_INFINITY,
        }
    }

    /// Goes on to a request and charges it.
    pub fn visit(&self, scenario: &Scenario, request: usize) -> Self {
        let asked = &scenario.requests[request];
        let target = &scenario.sensors[asked.sensor].place;
        let arrive_s = self.meets(scenario, request + 2, target).max(asked.ready_s);
        let place = target.at(arrive_s);
        let left_j = (asked.residual_j - asked.drain_w * arrive_s).max(0.0);
        let charge_j = (scenario.target_j(asked) - left_j).max(0.0);
        Self {
            row: request + 2,
            place,
            arrive_s,
            time_s: arrive_s + charge_j / scenario.charger.transfer_w,
            length_m: self.length_m + self.leg_m(scenario, request + 2, place),
            charged_j: self.charged_j + charge_j,
            strain: self.strain.max(strain(arrive_s, asked.deadline_s)),
        }
    }

    /// Goes to the end of the tour.
    pub fn home(&self, scenario: &Scenario) -> Self {
        let charger = &scenario.charger;
        let leg_m = self.leg_m(scenario, 1, charger.end_m);
        let time_s = self.time_s + leg_m / charger.speed_mps;
        let home = Self { time_s, length_m: self.length_m + leg_m, ..*self };
        let limits = strain(time_s, charger.timespan_s)
            .max(strain(home.energy_j(scenario), charger.capacity_j));
        Self { strain: self.strain.max(limits), ..home }
    }

    /// The whole tour that serves these requests in order.
    pub fn along(scenario: &Scenario, order: &[usize]) -> Self {
        let begin = Self::begin(scenario);
        order.iter().fold(begin, |at, &request| at.visit(scenario, request)).home(scenario)
    }

    /// Whether time span and energy are not yet used up, before the way home.
    pub fn is_affordable(&self, scenario: &Scenario, most: f64) -> bool {
        let charger = &scenario.charger;
        strain(self.time_s, charger.timespan_s) <= most
            && strain(self.energy_j(scenario), charger.capacity_j) <= most
    }

    /// Energy delivered and travelled, in joules.
    pub fn energy_j(&self, scenario: &Scenario) -> f64 {
        self.charged_j + scenario.charger.travel_jpm * self.length_m
    }

    fn leg_m(&self, scenario: &Scenario, column: usize, to: Point) -> f64 {
        let straight = (to - self.place).norm();
        scenario.travel.as_ref().map_or(straight, |matrix| matrix.get(self.row, column))
    }

    /// When the charger reaches a sensor that waits for it, or that goes its way.
    fn meets(&self, scenario: &Scenario, column: usize, target: &Place) -> f64 {
        let speed_mps = scenario.charger.speed_mps;
        if let Place::Fixed(point) = target {
            return self.time_s + self.leg_m(scenario, column, *point) / speed_mps;
        }
        // The charger is faster, so that once in reach is always in reach.
        let late = |t: f64| (target.at(t) - self.place).norm() > speed_mps * (t - self.time_s);
        let (mut low, mut high) = (self.time_s, self.time_s + 1e4);
        for _ in 0..90 {
            let middle = 0.5 * (low + high);
            if late(middle) { low = middle } else { high = middle }
        }
        high
    }
}

fn strain(value: f64, limit: Option<f64>) -> f64 {
    limit.map_or(f64::NEG_INFINITY, |limit| (value - limit) / tolerance(limit))
}
