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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;
    use crate::scenario::Scenario;

    const SPEED_MPS: f64 = 5.0;

    /// The place of a sensor with these rows, by way of a scenario.
    fn moving(rows: &[[f64; 3]]) -> Place {
        let document = json!({
            "format": "voltour/scenario/1", "objective": "max_count", "requests": [],
            "charger": { "start_m": [0, 0], "speed_mps": SPEED_MPS, "travel_jpm": 0, "transfer_w": 1 },
            "sensors": [{ "id": "s", "trajectory": rows, "battery_j": 1 }],
        });
        Scenario::from_json(document.to_string().as_bytes()).unwrap().sensors[0].place.clone()
    }

    fn departure(from: [f64; 2], leave_s: f64, ready_s: f64) -> Departure {
        Departure { from: from.into(), leave_s, ready_s, speed_mps: SPEED_MPS }
    }

    /// Linear between the rows, written as plainly as can be.
    fn place_at(rows: &[[f64; 3]], t: f64) -> Point {
        let mut place = Point::new(rows[0][1], rows[0][2]);
        for pair in rows.windows(2) {
            let share = ((t - pair[0][0]) / (pair[1][0] - pair[0][0])).clamp(0.0, 1.0);
            if t > pair[0][0] {
                let (a, b) =
                    (Point::new(pair[0][1], pair[0][2]), Point::new(pair[1][1], pair[1][2]));
                place = a + (b - a) * share;
            }
        }
        place
    }

    #[test]
    fn chases_and_meets_head_on() {
        // Five metres a second after a sensor that flees at three from 20 m ahead: ten seconds.
        let meeting =
            meet(&moving(&[[0.0, 20.0, 0.0], [100.0, 320.0, 0.0]]), departure([0.0; 2], 0.0, 0.0));
        assert_eq!((meeting.at_s, meeting.distance_m), (10.0, 50.0));
        // Towards each other at five and three from 80 m: ten seconds again.
        let meeting =
            meet(&moving(&[[0.0, 80.0, 0.0], [20.0, 20.0, 0.0]]), departure([0.0; 2], 0.0, 0.0));
        assert_eq!((meeting.at_s, meeting.distance_m), (10.0, 50.0));
    }

    #[test]
    fn rests_before_the_first_row_and_after_the_last() {
        let rows = [[40.0, 30.0, 40.0], [50.0, 30.0, 50.0]];
        let early = meet(&moving(&rows), departure([0.0; 2], 0.0, 0.0));
        assert_eq!((early.at_s, early.distance_m), (10.0, 50.0));
        let late = meet(&moving(&rows), departure([30.0, 0.0], 45.0, 0.0));
        assert_eq!((late.at_s, late.distance_m), (55.0, 50.0));
        let past =
            meet(&moving(&[[-20.0, 0.0, 0.0], [-10.0, 5.0, 0.0]]), departure([0.0; 2], 0.0, 0.0));
        assert_eq!((past.at_s, past.distance_m), (1.0, 5.0));
    }

    #[test]
    fn a_closed_place_is_awaited_and_met_where_the_sensor_is_then() {
        let meeting =
            meet(&moving(&[[0.0, 10.0, 0.0], [60.0, 40.0, 0.0]]), departure([0.0; 2], 0.0, 30.0));
        assert_eq!(
            (meeting.at_s, meeting.place, meeting.distance_m),
            (30.0, Point::new(25.0, 0.0), 25.0)
        );
    }

    proptest! {
        /// Against a clock that ticks in hundredths: not reached a tick before, reached a tick after.
        #[test]
        fn agrees_with_fine_time_steps(
            corners in prop::collection::vec((1.0..40.0f64, -1.0..1.0f64, -1.0..1.0f64), 0..6),
            first in (-60.0..60.0f64, -100.0..100.0f64, -100.0..100.0f64),
            from in (-100.0..100.0f64, -100.0..100.0f64),
            leave_s in 0.0..80.0f64,
            ready_s in prop_oneof![Just(0.0), 0.0..150.0f64],
        ) {
            let mut rows = vec![[first.0, first.1, first.2]];
            for (seconds, vx, vy) in corners {
                let [t, x, y] = rows[rows.len() - 1];
                // Up to 3.4 times the square root of two: just below the charger's speed.
                rows.push([t + seconds, x + 3.4 * vx * seconds, y + 3.4 * vy * seconds]);
            }
            let from = Point::new(from.0, from.1);
            let meeting = meet(&moving(&rows), departure([from.x, from.y], leave_s, ready_s));
            let earliest_s = leave_s.max(ready_s);
            let reached = |t: f64| (place_at(&rows, t) - from).norm() <= SPEED_MPS * (t - leave_s) + 1e-9;
            let mut tick = 0;
            while !reached(earliest_s + f64::from(tick) * 0.01) {
                tick += 1;
                prop_assert!(tick < 1_000_000);
            }
            let found_s = earliest_s + f64::from(tick) * 0.01;
            prop_assert!(meeting.at_s <= found_s + 1e-6 && meeting.at_s >= found_s - 0.01 - 1e-6);
            prop_assert!(meeting.at_s >= earliest_s);
            let place = place_at(&rows, meeting.at_s);
            prop_assert!((meeting.place - place).norm() < 1e-6);
            prop_assert!((meeting.distance_m - (place - from).norm()).abs() < 1e-6);
            if meeting.at_s > earliest_s {
                prop_assert!((meeting.distance_m - SPEED_MPS * (meeting.at_s - leave_s)).abs() < 1e-6);
            }
        }
    }
}
