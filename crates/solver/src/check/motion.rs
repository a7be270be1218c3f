//! Where and when a charger meets a sensor, by closed form; the only place that knows of motion.

use nalgebra::Vector2;

use crate::scenario::{Place, Point, Trajectory};

/// The beginning of a charge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Meeting {
    pub(super) at_s: f64,
    pub(super) place: Point,
    pub(super) distance_m: f64,
}

/// A charger on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure {
    pub(super) from: Point,
    pub(super) leave_s: f64,
    pub(super) ready_s: f64,
    pub(super) speed_mps: f64,
}

/// The earliest `a >= max(leave, ready)` at which the charger can be where the sensor is.
pub(super) fn meet(place: &Place, departure: Departure) -> Meeting {
    match place {
        Place::Fixed(point) => at_rest(*point, departure),
        Place::Moving(trajectory) => on_the_move(trajectory, departure),
    }
}

fn at_rest(place: Point, departure: Departure) -> Meeting {
    let distance_m = (place - departure.from).norm();
    let reached_s = departure.leave_s + distance_m / departure.speed_mps;
    Meeting { at_s: reached_s.max(departure.ready_s), place, distance_m }
}

/// A stretch of constant velocity that lasts until `until_s`.
struct Leg {
    since_s: f64,
    until_s: f64,
    from: Point,
    velocity: Vector2<f64>,
}

fn on_the_move(trajectory: &Trajectory, departure: Departure) -> Meeting {
    let earliest_s = departure.leave_s.max(departure.ready_s);
    let legs = legs(trajectory);
    let last = legs.len() - 1;
    for (i, leg) in legs.iter().enumerate() {
        if leg.until_s < earliest_s && i < last {
            continue;
        }
        let begin_s = leg.since_s.max(earliest_s);
        let wait_s = time_to_catch(leg, begin_s, departure);
        let at_s = begin_s + wait_s;
        if at_s <= leg.until_s || i == last {
            let place = leg.from + leg.velocity * (at_s - leg.since_s);
            return Meeting { at_s, place, distance_m: (place - departure.from).norm() };
        }
    }
    // Unreachable: the last leg always returns, and a trajectory has at least one row.
    at_rest(departure.from, departure)
}

/// At rest before the first row, from row to row, at rest after the last.
fn legs(trajectory: &Trajectory) -> Vec<Leg> {
    let rows = trajectory.waypoints();
    let still = Vector2::zeros();
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let before = Leg {
        // A leg at rest may begin anywhere; a finite time keeps the arithmetic finite.
        since_s: first.time_s.min(0.0),
        until_s: first.time_s,
        from: first.position_m,
        velocity: still,
    };
    let moving = rows.windows(2).map(|pair| Leg {
        since_s: pair[0].time_s,
        until_s: pair[1].time_s,
        from: pair[0].position_m,
        velocity: (pair[1].position_m - pair[0].position_m) / (pair[1].time_s - pair[0].time_s),
    });
    let after = Leg {
        since_s: last.time_s,
        until_s: f64::INFINITY,
        from: last.position_m,
        velocity: still,
    };
    std::iter::once(before).chain(moving).chain([after]).collect()
}

/// The smallest u >= 0 with |d + v u| <= w + S u, where d leads from the charger's last place to
/// the sensor at `begin_s` and w is how far the charger can have come by then. As v < S the left
/// side falls behind once and for all, so it is the larger root of a quadratic:
/// (S^2 - v^2) u^2 + 2 (w S - d v) u + (w^2 - d^2) = 0.
fn time_to_catch(leg: &Leg, begin_s: f64, departure: Departure) -> f64 {
    let speed = departure.speed_mps;
    let gap = leg.from + leg.velocity * (begin_s - leg.since_s) - departure.from;
    let reach = speed * (begin_s - departure.leave_s);
    let ahead = gap.norm();
    if ahead <= reach {
        return 0.0;
    }
    let square = speed * speed - leg.velocity.norm_squared();
    let half = reach * speed - gap.dot(&leg.velocity);
    let rest = (reach - ahead) * (reach + ahead);
    let root = (half * half - square * rest).sqrt();
    // Of the two forms of the same root, the one that does not subtract like from like.
    if half > 0.0 { -rest / (half + root) } else { (root - half) / square }
}
