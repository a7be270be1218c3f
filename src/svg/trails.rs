//! Where moving sensors go, and where they went until the charger met them.

use std::fmt::Write as _;

use ::svg::node::element::{Circle, Group, Path};
use voltour_solver::plan::Stop;
use voltour_solver::scenario::{Place, Trajectory};

use super::scene::{MANY, Role, Scene, horizon};
use super::view::tenth;

/// Points of all trails together.
const MOST_POINTS: usize = 60_000;
/// The share of the tour's time that a trail shows: whole ways would bury the tour.
const RECENT: f64 = 0.05;

/// Dotted: the first ways of those that are not met. Blue: the last way to the meeting, and after it
/// nothing, for what a sensor does then does not matter; strong while the charger was driving towards it.
pub(super) fn trails(scene: &Scene<'_>) -> Group {
    let recent_s = RECENT * horizon(scene.scenario, scene.plan);
    let mut group = Group::new();
    let mut left = MOST_POINTS;
    for (sensor, role) in scene.sensors().take(MANY) {
        let Place::Moving(trajectory) = &sensor.place else { continue };
        group = match role {
            Role::Stop(order) => met(group, scene, trajectory, (order, recent_s), &mut left),
            _ => group.add(path("trail", way(scene, trajectory, [0.0, recent_s], &mut left))),
        };
    }
    group
}

fn met(
    into: Group,
    scene: &Scene<'_>,
    trajectory: &Trajectory,
    (order, recent_s): (usize, f64),
    left: &mut usize,
) -> Group {
    let time =
        |stop: Option<&Stop>, of: fn(&Stop) -> f64| stop.map_or(0.0, of).clamp(0.0, f64::MAX);
    let stops = &scene.plan.stops;
    let drives_s = time(order.checked_sub(1).and_then(|i| stops.get(i)), |s| s.depart_s);
    let meets_s = time(stops.get(order), |s| s.arrive_s).max(drives_s);
    let from_s = (drives_s - recent_s).max(0.0);
    let [x, y] = scene.view.at(trajectory.at(from_s).into()).map(tenth);
    into.add(path("met", way(scene, trajectory, [from_s, drives_s], left)))
        .add(path("last", way(scene, trajectory, [drives_s, meets_s], left)))
        .add(Circle::new().set("class", "was").set("cx", x).set("cy", y).set("r", 3))
}

fn path(class: &str, way: String) -> Path {
    Path::new().set("class", class).set("d", way)
}

/// Between two times; waypoints closer than the eye can tell are left out.
fn way(
    scene: &Scene<'_>,
    trajectory: &Trajectory,
    [from, until]: [f64; 2],
    left: &mut usize,
) -> String {
    let place = |time: f64| scene.view.at(trajectory.at(time).into()).map(tenth);
    let mut last = place(from);
    let mut data = format!("M{} {}", last[0], last[1]);
    let between = trajectory.waypoints().iter().filter(|w| w.time_s > from && w.time_s < until);
    for next in between.map(|w| scene.view.at(w.position_m.into()).map(tenth)) {
        let apart = (next[0] - last[0]).abs().max((next[1] - last[1]).abs());
        if apart >= 1.0 && *left > 0 {
            let _ = write!(data, "L{} {}", next[0], next[1]);
            last = next;
            *left -= 1;
        }
    }
    let end = place(until);
    let _ = write!(data, "L{} {}", end[0], end[1]);
    data
}
