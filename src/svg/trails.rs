//! Where moving sensors go, and as far as they went when the charger met them.

use std::fmt::Write as _;

use ::svg::node::element::{Circle, Group, Path};
use voltour_solver::scenario::{Place, Trajectory};

use super::scene::{MANY, Role, Scene, horizon};
use super::view::tenth;

/// Points of all trails together.
const MOST_POINTS: usize = 60_000;

/// Dotted: the way until the tour is over. Solid: the way until the meeting.
pub(super) fn trails(scene: &Scene<'_>) -> Group {
    let until = horizon(scene.scenario, scene.plan);
    let mut group = Group::new();
    let mut left = MOST_POINTS;
    for (sensor, role) in scene.sensors().take(MANY) {
        let Place::Moving(trajectory) = &sensor.place else { continue };
        let way = way(scene, trajectory, until, &mut left);
        group = group.add(Path::new().set("class", "trail").set("d", way));
        let stop = match role {
            Role::Stop(order) => scene.plan.stops.get(order),
            _ => None,
        };
        if let Some(stop) = stop {
            let [x, y] = scene.view.at(trajectory.at(0.0).into());
            let met = way_to_meeting(scene, trajectory, stop.arrive_s, &mut left);
            group = group.add(Path::new().set("class", "met").set("d", met)).add(
                Circle::new()
                    .set("class", "was")
                    .set("cx", tenth(x))
                    .set("cy", tenth(y))
                    .set("r", 3),
            );
        }
    }
    group
}

fn way_to_meeting(scene: &Scene<'_>, trajectory: &Trajectory, at: f64, left: &mut usize) -> String {
    way(scene, trajectory, if at.is_finite() { at.max(0.0) } else { 0.0 }, left)
}

/// From second 0 on; waypoints closer than the eye can tell are left out.
fn way(scene: &Scene<'_>, trajectory: &Trajectory, until: f64, left: &mut usize) -> String {
    let place = |time: f64| scene.view.at(trajectory.at(time).into()).map(tenth);
    let mut last = place(0.0);
    let mut data = format!("M{} {}", last[0], last[1]);
    let between = trajectory.waypoints().iter().filter(|w| w.time_s > 0.0 && w.time_s < until);
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
