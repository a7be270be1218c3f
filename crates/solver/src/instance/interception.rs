//! The earliest moment at which the charger can meet a sensor that moves.

use crate::scenario::{Point, Trajectory};

/// The earliest `a >= not_before` with `|p(a) - from| <= speed (a - leave)`, in seconds.
///
/// The sensor is slower than the charger, so `speed (a - leave) - |p(a) - from|` rises with `a`: the
/// piece of the trajectory is found by bisection, and in it the only root by the quadratic formula, in
/// the form that subtracts no nearly equal numbers. `not_before >= leave`.
pub fn earliest(
    trajectory: &Trajectory,
    from: Point,
    leave_s: f64,
    not_before_s: f64,
    speed_mps: f64,
) -> f64 {
    let in_reach =
        |at: Point, time_s: f64| (at - from).norm() <= speed_mps * (time_s - leave_s).max(0.0);
    let start = trajectory.at(not_before_s);
    if in_reach(start, not_before_s) {
        return not_before_s;
    }
    let rows = trajectory.waypoints();
    let met = rows
        .partition_point(|row| row.time_s <= not_before_s || !in_reach(row.position_m, row.time_s));
    let mut begin = (not_before_s, start);
    if met > 0 && rows[met - 1].time_s > not_before_s {
        begin = (rows[met - 1].time_s, rows[met - 1].position_m);
    }
    let Some(end) = rows.get(met) else {
        // At rest behind its last row, or before its only one.
        return begin.0.max(leave_s + (begin.1 - from).norm() / speed_mps);
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
    begin.0 + after.clamp(0.0, seconds)
}
