//! The sensors that are no stops: dots for those that asked for nothing, a shape of its own for each
//! reason why a request is not served.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;

use ::svg::node::element::{Circle, Group, Path, Title};
use voltour_solver::plan::Reason;
use voltour_solver::scenario::{Request, Sensor};

use super::labels::{Area, Room};
use super::scene::{Role, Scene};
use super::style;
use super::text::{clean, duration, joules, short};
use super::view::tenth;

/// Past so many sensors their ids are left to the tooltips.
const MOST_IDS: usize = 250;

/// Every sensor that is no stop.
pub(super) fn sensors(scene: &Scene<'_>, room: &mut Room) -> Group {
    if scene.is_crowded() { merged(scene) } else { each(scene, room) }
}

fn each(scene: &Scene<'_>, room: &mut Room) -> Group {
    // Requests lie above the sensors that asked for nothing.
    let (mut idle, mut asked) = (Group::new(), Group::new());
    let scale = if scene.scenario.sensors.len() > 500 { 0.7 } else { 1.0 };
    for (sensor, role) in scene.sensors() {
        let at = scene.view.at(sensor.place.at(0.0).into()).map(tenth);
        match role {
            Role::Stop(_) => {}
            Role::Idle => {
                room.take(Area::around(at, 3.0));
                let dot = Circle::new().set("class", "idle").set("cx", at[0]).set("cy", at[1]);
                idle =
                    idle.add(dot.set("r", tenth(3.2 * scale)).add(Title::new(idle_title(sensor))));
            }
            Role::Unserved(reason) => {
                room.take(Area::around(at, 6.0));
                let request = scene.request_of(&sensor.id);
                asked = unserved(asked, sensor, request, reason, at, scale);
            }
        }
    }
    Group::new().add(idle).add(asked)
}

fn unserved(
    into: Group,
    sensor: &Sensor,
    request: Option<&Request>,
    reason: Reason,
    [x, y]: [f64; 2],
    scale: f64,
) -> Group {
    let mark = style::mark(reason);
    let words = unserved_title(sensor, request, mark.legend);
    let shape = Path::new().set("class", mark.class).add(Title::new(words));
    let into = into.add(match scale {
        1.0 => shape.set("d", format!("M{x} {y}{}", mark.shape)),
        _ => shape
            .set("d", format!("M0 0{}", mark.shape))
            .set("transform", format!("translate({x} {y}) scale({scale})")),
    });
    match request {
        Some(request) if request.required => {
            let ring = Circle::new().set("class", "must").set("cx", x).set("cy", y);
            into.add(ring.set("r", tenth(9.5 * scale)))
        }
        _ => into,
    }
}

fn idle_title(sensor: &Sensor) -> String {
    format!("{}\nno request", clean(&sensor.id))
}

fn unserved_title(sensor: &Sensor, request: Option<&Request>, why: &str) -> String {
    let mut words = format!("{}\nnot served: {}", clean(&sensor.id), why.to_lowercase());
    if let Some(request) = request {
        let _ =
            write!(words, "\n{} of {} left", joules(request.residual_j), joules(sensor.battery_j));
        if let Some(deadline) = request.deadline_s {
            let _ = write!(words, "\ndeadline {}", duration(deadline));
        }
        if request.required {
            words.push_str("\nrequired");
        }
    }
    words
}

/// One path a kind, with one dot for what falls on one spot: as large as the map at most.
fn merged(scene: &Scene<'_>) -> Group {
    let mut kinds: BTreeMap<&str, (HashSet<[i32; 2]>, String)> = BTreeMap::new();
    for (sensor, role) in scene.sensors() {
        let colour = match role {
            Role::Stop(_) => continue,
            Role::Idle => "#9aa5b1",
            Role::Unserved(reason) => style::mark(reason).colour,
        };
        let at = scene.view.at(sensor.place.at(0.0).into());
        let spot = at.map(|c| (c / 2.0).round() as i32);
        let (seen, data) = kinds.entry(colour).or_default();
        if seen.insert(spot) {
            let _ = write!(data, "M{} {}h0", spot[0] * 2, spot[1] * 2);
        }
    }
    let dots = |(colour, (_, data)): (&str, (_, String))| {
        Path::new().set("class", "many").set("stroke", colour).set("d", data)
    };
    // The sensors that asked for nothing first, so that the others lie above them.
    let idle = kinds.remove("#9aa5b1").map(|kind| dots(("#9aa5b1", kind)));
    let group = idle.into_iter().fold(Group::new(), Group::add);
    kinds.into_iter().map(dots).fold(group, Group::add)
}

/// The ids, where there is room; those of requests first.
pub(super) fn ids(scene: &Scene<'_>, room: &mut Room) -> Group {
    let mut group = Group::new();
    if scene.scenario.sensors.len() > MOST_IDS {
        return group;
    }
    let rank = |role: Role| match role {
        Role::Stop(_) => 0,
        Role::Unserved(_) => 1,
        Role::Idle => 2,
    };
    for wanted in 0..=2 {
        for (sensor, role) in scene.sensors().filter(|(_, role)| rank(*role) == wanted) {
            let (at, radius) = match role {
                Role::Stop(order) => match scene.plan.stops.get(order) {
                    Some(stop) => (stop.position_m, super::tour::radius(scene)),
                    None => continue,
                },
                Role::Unserved(_) => (sensor.place.at(0.0).into(), 6.0),
                Role::Idle => (sensor.place.at(0.0).into(), 3.0),
            };
            group = room.write(group, &short(&sensor.id, 16), "id", scene.view.at(at), radius);
        }
    }
    group
}
