//! The ground: grid, field, sensing disks, and the places where coverage falls short.

use std::collections::HashSet;
use std::fmt::Write as _;

use ::svg::node::element::{Circle, ClipPath, Group, Path, Rectangle, Text, Title};
use voltour_solver::plan::{Violation, Warning};
use voltour_solver::scenario::Coverage;

use super::labels::{Area, Room};
use super::scene::Scene;
use super::style;
use super::view::{LEFT, TOP, WIDTH, tenth};

/// Past so many, disks say nothing any more and take renderers long.
pub(super) const MOST_DISKS: usize = 5000;
const MOST_WITNESSES: usize = 400;

/// The map's sheet with its grid and axes.
pub(super) fn ground(scene: &Scene<'_>) -> Group {
    let view = &scene.view;
    let sheet = Rectangle::new()
        .set("class", "map")
        .set("x", LEFT)
        .set("y", TOP)
        .set("width", WIDTH)
        .set("height", tenth(view.height))
        .set("rx", 6);
    let mut lines = String::new();
    let mut group = Group::new().add(sheet);
    let tick = |x: f64, y: f64, class: &str, words: String| {
        Text::new(words).set("class", class).set("x", tenth(x)).set("y", tenth(y))
    };
    for (x, words) in view.ticks(0) {
        let _ = write!(lines, "M{} {TOP}V{}", tenth(x), tenth(view.bottom()));
        group = group.add(tick(x, view.bottom() + 16.0, "tick mid", words));
    }
    for (y, words) in view.ticks(1) {
        let _ = write!(lines, "M{LEFT} {}H{}", tenth(y), view.right());
        group = group.add(tick(LEFT - 7.0, y + 4.0, "tick end", words));
    }
    let unit = tick(view.right(), view.bottom() + 32.0, "tick end", "metres".into());
    group.add(Path::new().set("class", "grid").set("d", lines)).add(unit)
}

/// What is cut at the map's and at the field's border.
pub(super) fn clips(scene: &Scene<'_>) -> Group {
    let sheet = Rectangle::new()
        .set("x", LEFT)
        .set("y", TOP)
        .set("width", WIDTH)
        .set("height", tenth(scene.view.height))
        .set("rx", 6);
    let group = Group::new().add(ClipPath::new().set("id", "map").add(sheet));
    match &scene.scenario.coverage {
        Some(coverage) => {
            let border = Path::new().set("d", border(scene, coverage));
            group.add(ClipPath::new().set("id", "field").add(border))
        }
        None => group,
    }
}

/// The field and the disks: darker where more living sensors cover, dashed where one will be dead.
pub(super) fn field(scene: &Scene<'_>) -> Option<Group> {
    let coverage = scene.scenario.coverage.as_ref()?;
    let outline = border(scene, coverage);
    let ground = Path::new().set("class", "field").set("d", outline.clone());
    let edge = Path::new().set("class", "edge").set("d", outline);
    let mut alive = Group::new()
        .set("class", "alive")
        .set("clip-path", "url(#field)")
        .set("fill-opacity", softness(scene, coverage));
    let mut dead = Group::new().set("class", "dead").set("clip-path", "url(#field)");
    if scene.scenario.sensors.len() <= MOST_DISKS {
        for (sensor, role) in scene.sensors() {
            let [x, y] = scene.view.at(sensor.place.at(0.0).into());
            let radius = scene.view.length(sensor.range_m.unwrap_or(0.0));
            let disk =
                Circle::new().set("cx", tenth(x)).set("cy", tenth(y)).set("r", tenth(radius));
            if role.is_alive() {
                alive = alive.add(disk);
            } else {
                dead = dead.add(disk);
            }
        }
    }
    Some(Group::new().add(ground).add(alive).add(dead).add(edge))
}

/// The opacity at which an average place, under all disks that cover it, is a third filled.
fn softness(scene: &Scene<'_>, coverage: &Coverage) -> f64 {
    let alive = scene.sensors().filter(|(_, role)| role.is_alive());
    let disk = |range: f64| std::f64::consts::PI * range * range;
    let area: f64 = alive.map(|(sensor, _)| disk(sensor.range_m.unwrap_or(0.0))).sum();
    let layers = (area / coverage.field.area_m2()).clamp(1.0, 400.0);
    let opacity = 1.0 - 0.66_f64.powf(1.0 / layers);
    if opacity.is_finite() { (opacity * 1e4).round() / 1e4 } else { 0.05 }
}

fn border(scene: &Scene<'_>, coverage: &Coverage) -> String {
    // Corners that fall on one place of the picture are drawn once.
    let mut last = [f64::NAN; 2];
    let mut data = String::new();
    for &corner in coverage.field.corners() {
        let place = scene.view.at(corner.into()).map(tenth);
        if place != last {
            let _ = write!(
                data,
                "{}{} {}",
                if data.is_empty() { 'M' } else { 'L' },
                place[0],
                place[1]
            );
            last = place;
        }
    }
    data.push('Z');
    data
}

/// Triangles where the tour leaves too few covers, and where the deployment had too few already.
pub(super) fn witnesses(scene: &Scene<'_>, room: &mut Room) -> Group {
    let below = scene.plan.warnings.iter().map(|Warning::BelowK { at_m, needs, has }| {
        ("belowk", *at_m, format!("Never covered {needs} times: {has} sensors reach this place"))
    });
    let short = scene.plan.violations.iter().filter_map(|violation| match violation {
        Violation::Coverage { at_m, needs, has } => {
            Some(("short", *at_m, format!("Coverage falls short: needs {needs}, keeps {has}")))
        }
        _ => None,
    });
    let mut seen = HashSet::new();
    let mut group = Group::new();
    for (class, at, words) in below.chain(short) {
        let [x, y] = scene.view.at(at).map(tenth);
        // One mark for what falls on one spot.
        let spot = (class, (x / 6.0) as i64, (y / 6.0) as i64);
        if seen.len() < MOST_WITNESSES && seen.insert(spot) {
            room.take(Area::around([x, y], 5.0));
            let large = class == "short" && scene.plan.violations.len() <= 100;
            let shape = if large { style::TRIANGLE } else { style::SMALL_TRIANGLE };
            let data = format!("M{x} {y}{shape}");
            group =
                group.add(Path::new().set("class", class).set("d", data).add(Title::new(words)));
        }
    }
    group
}
