//! Ranges of options, and the parts of a document that all presets share.

use crate::scenario::SensorDocument;

use super::GenerateError;

type Valid = Result<(), GenerateError>;

/// The rule that an option must hold.
pub(super) fn option(name: &'static str, value: f64, rule: &str, holds: bool) -> Valid {
    let error = || GenerateError::Option { name, value, rule: rule.to_owned() };
    holds.then_some(()).ok_or_else(error)
}

pub(super) fn positive(name: &'static str, value: f64) -> Valid {
    option(name, value, "must be > 0", value > 0.0 && value.is_finite())
}

pub(super) fn not_negative(name: &'static str, value: f64) -> Valid {
    option(name, value, "must be >= 0", value >= 0.0 && value.is_finite())
}

/// In [0, 1].
pub(super) fn share(name: &'static str, value: f64) -> Valid {
    option(name, value, "must be in [0, 1]", (0.0..=1.0).contains(&value))
}

/// At most `limit`, which another option sets.
pub(super) fn at_most(name: &'static str, value: f64, other: &str, limit: f64) -> Valid {
    option(name, value, &format!("must be at most {other}, {limit}"), value <= limit)
}

/// Below `limit`, which another option sets.
pub(super) fn below(name: &'static str, value: f64, other: &str, limit: f64) -> Valid {
    option(name, value, &format!("must be less than {other}, {limit}"), value < limit)
}

/// A number of things, at least one and not so many that memory is at stake.
pub(super) fn count(name: &'static str, value: u32) -> Valid {
    const MOST: u32 = 1_000_000;
    let rule = format!("must be 1 to {MOST}");
    option(name, f64::from(value), &rule, (1..=MOST).contains(&value))
}

/// A length: a side of millions of kilometres has no millionths of a metre left to draw.
pub(super) fn side(name: &'static str, value: f64) -> Valid {
    option(name, value, "must be 1 to 1e9 m", (1.0..=1e9).contains(&value))
}

/// A sensor at rest; the first is `s1`.
pub(super) fn sensor_at(i: usize, place: [f64; 2], battery_j: f64) -> SensorDocument {
    SensorDocument {
        id: id(i),
        position_m: Some(place),
        trajectory: None,
        range_m: None,
        battery_j,
    }
}

/// The id of the sensor of that index.
pub(super) fn id(i: usize) -> String {
    format!("s{}", i + 1)
}
