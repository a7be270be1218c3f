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
    let begin = match met {
        met if met > passed => (rows[met - 1].time_s, rows[met - 1].position_m),
        _ => (not_before_s, start),
    };
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
