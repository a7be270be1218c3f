//! The smallest scenarios that showed defects, so that none of them comes back.

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::Budget;
use voltour_solver::solvers::exact::{Verdict, decide};
use voltour_solver::stop::MaxIterations;

use crate::draw::awkward;
use crate::run::{AMPLE, exact};
use crate::truth::cost_of;

/// Only over `b` is there a way home that can be paid for, and only over `a` a way to `b`. In energy, the
/// charge of `b` lies in the same interval as that of `a`.
const WITHIN_AN_INTERVAL: &str = r#"{
  "format": "voltour/scenario/1", "objective": "max_count",
  "charger": { "start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10,
               "capacity_j": 1000 },
  "sensors": [ { "id": "a", "position_m": [10, 0], "battery_j": 100 },
               { "id": "b", "position_m": [10, 0], "battery_j": 100 } ],
  "requests": [ { "sensor": "a", "residual_j": 0, "required": true },
                { "sensor": "b", "residual_j": 99.9, "required": true } ],
  "travel": { "distance_m": [ [0, 0, 10, 5000], [0, 0, 0, 0], [0, 5000, 0, 0], [0, 10, 5000, 0] ] }
}"#;

#[test]
fn paths_within_an_interval_are_followed() {
    let scenario = Scenario::from_json(WITHIN_AN_INTERVAL.as_bytes()).unwrap();
    let verdict = decide(&Instance::new(&scenario), &mut Budget::new(&MaxIterations(AMPLE)));
    assert_eq!(verdict, Verdict::Feasible(vec![0, 1]));
}

/// The empty trip takes 20 s: three quarters of the tolerance more than it may.
const EMPTY_TRIP: &str = r#"{
  "format": "voltour/scenario/1", "objective": "min_distance",
  "charger": { "start_m": [0, 0], "end_m": [100, 0], "speed_mps": 5, "travel_jpm": 1,
               "transfer_w": 10, "timespan_s": 19.999985 },
  "sensors": [], "requests": []
}"#;

#[test]
fn an_empty_trip_within_the_tolerance_is_feasible() {
    let scenario = Scenario::from_json(EMPTY_TRIP.as_bytes()).unwrap();
    assert_eq!(check(&scenario, &exact(&scenario, 0, AMPLE)), []);
}

#[test]
fn two_iterations_are_no_worse_than_one() {
    let scenario = Scenario::from_document(&awkward(5, 2_000_203)).unwrap();
    let costs = [1, 2].map(|budget| cost_of(&scenario, exact(&scenario, 0, budget).objective));
    assert!(costs[1] <= costs[0], "{costs:?}");
}
