//! The paths of a scenario document in the words of the contract.

use voltour_solver::scenario::ScenarioError;

use super::Violations;

/// Adds what the scenario's validation found. `sensor` turns the index of a sensor and the rest of the
/// path into the contract's path, `other` any other path.
pub(super) fn add(
    violations: &mut Violations,
    error: &ScenarioError,
    sensor: impl Fn(usize, &str) -> String,
    other: impl Fn(&str) -> String,
) {
    match error {
        ScenarioError::Rule { path, value, rule } => {
            let field = match of_sensor(path) {
                Some((i, rest)) => sensor(i, &place(rest)),
                None => other(path),
            };
            violations.add(field, format!("{value}: {rule}"));
        }
        ScenarioError::Syntax { .. } => violations.add(other(""), error.to_string()),
    }
}

fn of_sensor(path: &str) -> Option<(usize, &str)> {
    let (index, rest) = path.strip_prefix("sensors[")?.split_once(']')?;
    Some((index.parse().ok()?, rest.strip_prefix('.').unwrap_or(rest)))
}

/// `trajectory[3]` is a waypoint of a place here.
fn place(rest: &str) -> String {
    match rest.strip_prefix("trajectory") {
        Some("") => "place.trajectory".into(),
        Some(row) => format!("place.trajectory.waypoints{row}"),
        None if rest == "position_m" => "place.position_m".into(),
        None => rest.into(),
    }
}
