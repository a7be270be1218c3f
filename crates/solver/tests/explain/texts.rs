//! The operator's text, whole, of hand-made scenarios.

use voltour_solver::explain::{Explanation, explain};
use voltour_solver::scenario::Scenario;
use voltour_solver::stop::MaxIterations;

use crate::conflicts::plan;

fn explained(document: &str) -> Explanation {
    let scenario = Scenario::from_json(document.as_bytes()).unwrap();
    explain(&scenario, &plan(&scenario, 1_000), 0, &MaxIterations(1_000_000))
}

/// A sub-region near (120, 80) that s4 and s9 alone can keep covered, both far away.
const FAR: &str = r#"{
  "format": "voltour/scenario/1", "name": "far", "objective": "min_distance",
  "charger": {"start_m": [2000, 80], "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20},
  "coverage": {"k": 1, "field_m": [[110, 70], [130, 70], [130, 90], [110, 90]]},
  "sensors": [
    {"id": "s4", "position_m": [100, 80], "range_m": 90, "battery_j": 10800},
    {"id": "s9", "position_m": [140, 80], "range_m": 90, "battery_j": 10800},
    {"id": "s1", "position_m": [1990, 80], "range_m": 50, "battery_j": 10800}
  ],
  "requests": [
    {"sensor": "s4", "deadline_s": 310, "residual_j": 1800},
    {"sensor": "s9", "deadline_s": 310, "residual_j": 1800},
    {"sensor": "s1", "deadline_s": 310, "residual_j": 1800}
  ]
}"#;

#[test]
fn a_sub_region_that_cannot_be_reached() {
    let expected = "\
infeasible: no tour keeps every constraint.

The sub-region at (110.07, 70.07) needs one of s4, s9 before 310 s; the charger cannot reach either in time: \
at the earliest s9 is reached at 372 s and s4 at 380 s.

Conflict (take any one of these away, and a tour exists that keeps the others):
  the sub-region at (110.07, 70.07) needs one of s4, s9
  s4 must be reached before 310 s
  s9 must be reached before 310 s

Not served:
  s4: it cannot be reached in time even as the only stop; alone it is reached at 380 s (deadline 310 s), \
ends at 1210 s and takes 2289000 J
  s9: it cannot be reached in time even as the only stop; alone it is reached at 372 s (deadline 310 s), \
ends at 1194 s and takes 2241000 J
  s1: the tour is as good without it; it would fit as the first stop (+20 m, +454 s, +21000 J)

What a change would buy:
  a deadline of 380 s for s4 (now 310) makes a feasible tour; no less would do (379.62 is proven too little) (tour: s4)
  a deadline of 372 s for s9 (now 310) makes a feasible tour; no less would do (371.63 is proven too little) (tour: s9)
  a speed of 6.01 m/s (now 5) makes a feasible tour; no less would do (5.97 is proven too little) (tour: s9)
";
    assert_eq!(explained(FAR).to_string(), expected);
}

#[test]
fn two_required_requests_and_a_time_span() {
    let expected = "\
infeasible: no tour keeps every constraint.

east is required; \"west 2\" is required; the charger must be at the end before 100 s: no tour keeps all of this together.

Conflict (take any one of these away, and a tour exists that keeps the others):
  east is required
  \"west 2\" is required
  the charger must be at the end before 100 s

Not served:
  \"west 2\": the tour does without it; as the first stop (+400 m, +90 s, +500 J) the tour would end 80 s too late
  near: it is charged already

Served:
  east: without it -400 m, -90 s, -500 J; a required request would not be served and one stop less would count

What a change would buy:
  a time span of 180 s (now 100) makes a feasible tour; no less would do (179.82 is proven too little) \
(tour: east, \"west 2\")
  a speed of 10.01 m/s (now 5) makes a feasible tour; no less would do (9.99 is proven too little) \
(tour: east, \"west 2\")
";
    assert_eq!(explained(TWO).to_string(), expected);
}

const TWO: &str = r#"{
  "format": "voltour/scenario/1", "objective": "max_count",
  "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10, "timespan_s": 100},
  "sensors": [
    {"id": "east", "position_m": [200, 0], "battery_j": 100},
    {"id": "west 2", "position_m": [-200, 0], "battery_j": 100},
    {"id": "near", "position_m": [0, 5], "battery_j": 100}
  ],
  "requests": [
    {"sensor": "east", "required": true, "residual_j": 0},
    {"sensor": "west 2", "required": true, "residual_j": 0},
    {"sensor": "near", "residual_j": 100}
  ]
}"#;

#[test]
fn a_feasible_tour_and_what_it_leaves() {
    let expected = "\
optimal: no tour is better.

Not served:
  c: the tour does without it; after a (+40 m, +18 s, +140 J) the tour would take 120 J more than there are
  d: it cannot be reached in time even as the only stop; alone it is reached at 80 s (deadline 50 s), \
ends at 170 s and takes 900 J

Served:
  a: without it +0 m, -10 s, -100 J; a reward of 2 would be lost
  b: without it -40 m, -18 s, -140 J; a reward of 5 would be lost

What a change would buy:
  a capacity of 420 J (now 300) has c served too: 10 in place of 7 (tour: a, c, b)
";
    assert_eq!(explained(REWARD).to_string(), expected);
}

const REWARD: &str = r#"{
  "format": "voltour/scenario/1", "objective": "max_reward",
  "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10, "capacity_j": 300},
  "sensors": [
    {"id": "a", "position_m": [20, 0], "battery_j": 100},
    {"id": "b", "position_m": [40, 0], "battery_j": 100},
    {"id": "c", "position_m": [60, 0], "battery_j": 100},
    {"id": "d", "position_m": [400, 0], "battery_j": 100}
  ],
  "requests": [
    {"sensor": "a", "residual_j": 0, "reward": 2},
    {"sensor": "b", "residual_j": 0, "reward": 5},
    {"sensor": "c", "residual_j": 0, "reward": 3, "deadline_s": 200},
    {"sensor": "d", "residual_j": 0, "reward": 3, "deadline_s": 50}
  ]
}"#;

#[test]
fn a_deadline_that_costs_way() {
    let expected = "\
optimal: no tour is better.

Served:
  c: without it -95.68 m, -29.14 s, -195.68 J; a required request would not be served
  a: without it -47.79 m, -19.56 s, -147.79 J; a required request would not be served
  b: without it -50.99 m, -20.2 s, -150.99 J; a required request would not be served

What a change would buy:
  a deadline of 53.01 s for c (now 25) shortens the tour by 92.27 m to 185.02 m (tour: a, b, c)
";
    assert_eq!(explained(DETOUR).to_string(), expected);
}

const DETOUR: &str = r#"{
  "format": "voltour/scenario/1", "objective": "min_distance",
  "charger": {"start_m": [0, 0], "end_m": [60, 80], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
  "sensors": [
    {"id": "a", "position_m": [50, 0], "battery_j": 100},
    {"id": "b", "position_m": [100, 10], "battery_j": 100},
    {"id": "c", "position_m": [60, 60], "battery_j": 100}
  ],
  "requests": [
    {"sensor": "a", "residual_j": 0, "required": true},
    {"sensor": "b", "residual_j": 0, "required": true},
    {"sensor": "c", "residual_j": 0, "required": true, "deadline_s": 25}
  ]
}"#;

#[test]
fn an_empty_trip_that_is_too_long() {
    println!(
        "{}",
        explained(
            &REWARD.replace("\"start_m\": [0, 0]", "\"start_m\": [0, 0], \"end_m\": [400, 0]")
        )
    );
}
