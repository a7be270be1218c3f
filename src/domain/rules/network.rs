//! The rules of a network.

use std::collections::HashSet;

use jiff::Timestamp;
use voltour_solver::scenario::Scenario;

use super::{Violations, path};
use crate::domain::{ChargerId, NetworkSpec, Place, Refusal, documents};

/// Sensors of a network at most.
const SENSORS: usize = 20_000;
/// Charger types of a network at most.
const CHARGER_TYPES: usize = 100;
/// Corners of a field at most.
const CORNERS: usize = 1_000;
/// Waypoints of a trajectory at most.
pub(super) const WAYPOINTS: usize = 10_000;
/// Waypoints of all trajectories of a network, or of one update, at most.
pub(super) const ALL_WAYPOINTS: usize = 1_000_000;

/// Judges what is put. It may take a while: every sensor is looked at.
///
/// # Errors
/// Every broken rule that was found, under paths that begin with `spec`.
pub fn network(spec: &NetworkSpec) -> Result<(), Refusal> {
    let mut violations = Violations::default();
    sizes(spec, &mut violations);
    if violations.0.is_empty() {
        names(spec, &mut violations);
        drains(spec, &mut violations);
        scenarios(spec, &mut violations);
    }
    violations.verdict()
}

fn sizes(spec: &NetworkSpec, violations: &mut Violations) {
    let types = spec.charger_types.len();
    if !(1..=CHARGER_TYPES).contains(&types) {
        let rule = format!("{types} charger types: must be 1 to {CHARGER_TYPES}");
        violations.add("spec.charger_types", rule);
    }
    let sensors = spec.sensors.len();
    if sensors > SENSORS {
        violations.add("spec.sensors", format!("{sensors} sensors: must be at most {SENSORS}"));
    }
    let corners = spec.coverage.as_ref().map_or(0, |coverage| coverage.field_m.len());
    if corners > CORNERS {
        let rule = format!("{corners} corners: must be at most {CORNERS}");
        violations.add("spec.coverage.field_m", rule);
    }
    let mut all = 0;
    for (i, sensor) in spec.sensors.iter().enumerate() {
        let Place::Trajectory(points) = &sensor.place else { continue };
        all += points.len();
        if points.len() > WAYPOINTS {
            let rule = format!("{} waypoints: must be at most {WAYPOINTS}", points.len());
            violations.add(format!("spec.sensors[{i}].place.trajectory.waypoints"), rule);
        }
    }
    if all > ALL_WAYPOINTS {
        violations.add("spec.sensors", format!("{all} waypoints: must be at most {ALL_WAYPOINTS}"));
    }
}

fn names(spec: &NetworkSpec, violations: &mut Violations) {
    let mut seen = HashSet::new();
    for (i, kind) in spec.charger_types.iter().enumerate() {
        let field = format!("spec.charger_types[{i}].name");
        if let Err(error) = kind.name.parse::<ChargerId>() {
            violations.add(field, error.to_string());
        } else if !seen.insert(kind.name.as_str()) {
            violations.add(field, format!("{:?}: must be unique in the network", kind.name));
        }
    }
}

fn drains(spec: &NetworkSpec, violations: &mut Violations) {
    for (i, sensor) in spec.sensors.iter().enumerate() {
        if sensor.drain_w.is_some() {
            violations.not_negative(&format!("spec.sensors[{i}].drain_w"), sensor.drain_w);
        }
    }
}

/// The rules of the scenario format, of each charger type; of the sensors with the slowest one, for
/// only its speed matters to them.
fn scenarios(spec: &NetworkSpec, violations: &mut Violations) {
    let types = &spec.charger_types;
    let start = origin(spec);
    let speed = |i: usize| types.get(i).map_or(0.0, |kind| kind.speed_mps);
    let slowest = (0..types.len()).min_by(|a, b| speed(*a).total_cmp(&speed(*b)));
    for (i, kind) in types.iter().enumerate() {
        let mut document = documents::document(spec, documents::charger(kind));
        if Some(i) == slowest {
            let sensor = |sensor| documents::sensor(sensor, &sensor.place, start);
            document.sensors = spec.sensors.iter().map(sensor).collect();
        } else {
            document.coverage = None;
        }
        if let Err(error) = Scenario::from_document(&document) {
            let sensor = |i, rest: &str| format!("spec.sensors[{i}].{rest}");
            let other = |path: &str| match path.strip_prefix("charger.") {
                Some(field) => format!("spec.charger_types[{i}].{field}"),
                None => format!("spec.{path}"),
            };
            path::add(violations, &error, sensor, other);
        }
    }
}

/// Any time near the waypoints does: it keeps the seconds after it exact.
fn origin(spec: &NetworkSpec) -> Timestamp {
    let first = spec.sensors.iter().find_map(|sensor| match &sensor.place {
        Place::Trajectory(points) => points.first(),
        Place::PositionM(_) => None,
    });
    first.map_or(Timestamp::UNIX_EPOCH, |point| point.time)
}
