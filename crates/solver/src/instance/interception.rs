//! The earliest moment at which the charger can meet a sensor that moves.

use crate::scenario::{Point, Trajectory, Waypoint};

/// The earliest `a >= not_before` with `|p(a) - from| <= speed (a - leave)`, in seconds, and `p(a)`.
///
/// The sensor is slower than the charger, so `speed (a - leave) - |p(a) - from|` rises with `a`: the
/// piece of the trajectory is found by bisection in steps that double, for most are met soon, and in it
/// the only root by the quadratic formula, in the form that subtracts no nearly equal numbers.
/// `not_before >= leave`.
pub fn earliest(
    trajectory: &Trajectory,
    from: Point,
    leave_s: f64,
    not_before_s: f64,
    speed_mps: f64,
) -> (f64, Point) {
    let in_reach =
        |at: Point, time_s: f64| (at - from).norm() <= speed_mps * (time_s - leave_s).max(0.0);
    let rows = trajectory.waypoints();
    let passed = trajectory.passed(not_before_s);
    let start = trajectory.behind(passed, not_before_s);
    if in_reach(start, not_before_s) {
        return (not_before_s, start);
    }
    let (mut missed, mut step) = (passed, 1);
    let escapes = |row: &Waypoint| !in_reach(row.position_m, row.time_s);
    while rows.get(missed + step - 1).is_some_and(escapes) {
        missed += step;
        step *= 2;
    }
    let until = rows.len().min(missed + step - 1);
    let met = missed + rows[missed..until].partition_point(escapes);
    let mut begin = (not_before_s, start);
    if met > passed {
        begin = (rows[met - 1].time_s, rows[met - 1].position_m);
    }
    let Some(end) = rows.get(met) else {
        // At rest behind its last row, or before its only one.
        return (begin.0.max(leave_s + (begin.1 - from).norm() / speed_mps), begin.1);
    };
    let seconds = end.time_s - begin.0;
    let velocity = (end.position_m - begin.1) / seconds;
    let gap = begin.1 - from;
    let reach = speed_mps * (begin.0 - leave_s);
    let a = speed_mps * speed_mps - velocity.norm_squared();
    let b = reach * speed_mps - gap.dot(&velocity);
    let c = (gap.norm() - reach) * (gap.norm() + reach);
    let root = (b * b + a * c).max(0.0).sqrt();
    let after = if b > 0.0 { c / (b + root) } else { (root - b) / a };
    let met_s = begin.0 + after.clamp(0.0, seconds);
    (met_s, trajectory.behind(met, met_s))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scenario::{Place, Scenario};

    const SPEED_MPS: f64 = 5.0;

    /// The trajectory over these legs, each a time and a way slower than the charger, from a first time on.
    fn trajectory(first_s: f64, legs: &[(f64, f64, f64)]) -> Trajectory {
        let mut row = (first_s, 40.0, 60.0);
        let mut rows = vec![format!("[{},{},{}]", row.0, row.1, row.2)];
        for &(seconds, share, angle) in legs {
            let metres = share * SPEED_MPS * seconds;
            row = (row.0 + seconds, row.1 + metres * angle.cos(), row.2 + metres * angle.sin());
            rows.push(format!("[{},{},{}]", row.0, row.1, row.2));
        }
        let text = format!(
            r#"{{"format":"voltour/scenario/1","objective":"max_count",
            "charger":{{"start_m":[0,0],"speed_mps":{SPEED_MPS},"travel_jpm":2,"transfer_w":20}},
            "sensors":[{{"id":"s","battery_j":200,"trajectory":[{}]}}],
            "requests":[{{"sensor":"s","residual_j":0}}]}}"#,
            rows.join(",")
        );
        let scenario = Scenario::from_json(text.as_bytes()).unwrap();
        let Place::Moving(trajectory) = &scenario.sensors[0].place else { panic!("it moves") };
        trajectory.clone()
    }

    fn legs() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
        let seconds = prop_oneof![0.001..0.1, 1.0..50.0, 500.0..5_000.0];
        prop::collection::vec((seconds, 0.0..0.95, 0.0..6.3), 0..30)
    }

    proptest! {
        #[test]
        fn waypoints_are_passed_at_their_times(first_s in -100.0..100.0, legs in legs(), share in -0.1..1.1) {
            let trajectory = trajectory(first_s, &legs);
            let rows = trajectory.waypoints();
            let span_s = rows[rows.len() - 1].time_s - rows[0].time_s + 1.0;
            let moments = rows.iter().map(|row| row.time_s).chain([rows[0].time_s + share * span_s]);
            for time_s in moments {
                let passed = rows.iter().filter(|row| row.time_s <= time_s).count();
                prop_assert_eq!(trajectory.passed(time_s), passed);
            }
        }

        #[test]
        fn nobody_is_met_sooner(
            first_s in -100.0..100.0,
            legs in legs(),
            leave_s in 0.0..3_000.0,
            wait_s in prop_oneof![Just(0.0), 0.0..500.0],
            x in -200.0..200.0,
        ) {
            let trajectory = trajectory(first_s, &legs);
            let (from, not_before_s) = (Point::new(x, 10.0), leave_s + wait_s);
            let (met_s, place) = earliest(&trajectory, from, leave_s, not_before_s, SPEED_MPS);
            let missed_m = |time_s: f64| {
                (trajectory.at(time_s) - from).norm() - SPEED_MPS * (time_s - leave_s)
            };
            prop_assert!(met_s >= not_before_s && (place - trajectory.at(met_s)).norm() < 1e-6);
            prop_assert!(missed_m(met_s) < 1e-6, "{} m off", missed_m(met_s));
            let sooner_s = met_s - 0.01;
            prop_assert!(sooner_s < not_before_s || missed_m(sooner_s) > 0.0, "{sooner_s}");
        }
    }
}
