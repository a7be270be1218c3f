//! The rules of a request, and of trajectories that come later.

use std::collections::HashSet;

use jiff::Timestamp;
use voltour_solver::scenario::Scenario;

use super::network::{ALL_WAYPOINTS, WAYPOINTS};
use super::{KnownNetwork, SLACK, Violations, path};
use crate::clock::plus;
use crate::domain::{NewRequest, Place, Refusal, Sensor, SensorId, TimedPoint, documents};

/// Judges a request by the present version of its network.
///
/// # Errors
/// Every broken rule that was found, under the names of the request's fields.
pub fn request(network: &KnownNetwork, asked: &NewRequest, now: Timestamp) -> Result<(), Refusal> {
    let mut violations = Violations::default();
    violations.not_negative("drain_w", asked.drain_w);
    violations.not_negative("reward", asked.reward);
    violations.not_negative("residual_j", asked.residual_j);
    if let (Some(ready), Some(deadline)) = (asked.ready, asked.deadline)
        && ready > deadline
    {
        violations.add("ready", format!("{ready}: must be at or before the deadline ({deadline})"));
    }
    if let Some(measured_at) = asked.measured_at
        && measured_at > plus(now, SLACK)
    {
        let rule = format!("{measured_at}: must be at most {} s ahead", SLACK.as_secs());
        violations.add("measured_at", rule);
    }
    let Some(sensor) = network.sensor(&asked.sensor_id) else {
        violations
            .add("sensor_id", format!("{:?}: no sensor of the network", asked.sensor_id.as_str()));
        return violations.verdict();
    };
    if let Some(residual_j) = asked.residual_j
        && residual_j > sensor.battery_j
    {
        let rule = format!("{residual_j}: must be at most the battery ({} J)", sensor.battery_j);
        violations.add("residual_j", rule);
    }
    match &asked.place {
        None => {}
        Some(Place::PositionM(position)) => violations.finite("place.position_m", Some(*position)),
        Some(Place::Trajectory(points)) => {
            trajectory(network, sensor, points, "place.trajectory", &mut violations);
        }
    }
    violations.verdict()
}

/// Judges trajectories that replace those of a network's sensors.
///
/// # Errors
/// Every broken rule that was found, under paths that begin with `trajectories`.
pub fn trajectories(
    network: &KnownNetwork,
    trajectories: &[(SensorId, Vec<TimedPoint>)],
) -> Result<(), Refusal> {
    let mut violations = Violations::default();
    let all: usize = trajectories.iter().map(|(_, points)| points.len()).sum();
    if all > ALL_WAYPOINTS {
        let rule = format!("{all} waypoints: must be at most {ALL_WAYPOINTS}");
        return Err(Refusal::invalid("trajectories", rule));
    }
    let mut seen = HashSet::new();
    for (i, (id, points)) in trajectories.iter().enumerate() {
        let field = format!("trajectories[{i}].sensor_id");
        if !seen.insert(id) {
            violations.add(field, format!("{:?}: at most one trajectory a sensor", id.as_str()));
            continue;
        }
        match network.sensor(id) {
            None => violations.add(field, format!("{:?}: no sensor of the network", id.as_str())),
            Some(sensor) => {
                let field = format!("trajectories[{i}].trajectory");
                trajectory(network, sensor, points, &field, &mut violations);
            }
        }
    }
    violations.verdict()
}

/// The rules of the scenario format on a trajectory, against the slowest charger.
fn trajectory(
    network: &KnownNetwork,
    sensor: &Sensor,
    points: &[TimedPoint],
    field: &str,
    violations: &mut Violations,
) {
    if points.len() > WAYPOINTS {
        let rule = format!("{} waypoints: must be at most {WAYPOINTS}", points.len());
        return violations.add(format!("{field}.waypoints"), rule);
    }
    let Some(slowest) = network.slowest() else { return };
    let start = points.first().map_or(Timestamp::UNIX_EPOCH, |point| point.time);
    let place = Place::Trajectory(points.to_vec());
    let mut document = documents::document(&network.spec, documents::charger(slowest));
    document.sensors = vec![documents::sensor(sensor, &place, start)];
    if let Err(error) = Scenario::from_document(&document) {
        let of_sensor = |_, rest: &str| match rest.strip_prefix("place.trajectory") {
            Some(rest) => format!("{field}{rest}"),
            None => field.to_owned(),
        };
        // Coverage and trajectories do not go together: here it is the trajectory that is too much.
        path::add(violations, &error, of_sensor, |_| field.to_owned());
    }
}
