//! The scenario document as it is written: optional fields are options, nothing is checked yet.
//! Whoever builds scenarios (the generator, the service) builds one of these and validates it
//! through [`Scenario::from_document`](super::Scenario::from_document).

use serde::Serialize;

use super::model::Objective;

/// The only value of the field `format`.
pub const FORMAT: &str = "voltour/scenario/1";

/// A whole scenario document. Units are in the field names: metres, seconds, joules, watts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Document {
    /// Always [`FORMAT`].
    pub format: String,
    /// Repeated by the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// What the tour optimises.
    pub objective: Objective,
    /// The charger.
    pub charger: ChargerDocument,
    /// Fraction of the battery to charge to; 1 if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub charge_level: Option<f64>,
    /// The coverage constraint, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage: Option<CoverageDocument>,
    /// All sensors that are alive, with or without a request.
    pub sensors: Vec<SensorDocument>,
    /// The charging requests.
    pub requests: Vec<RequestDocument>,
    /// Travel distances that are not Euclidean.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel: Option<TravelDocument>,
}

/// The field `charger`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChargerDocument {
    /// Where the charger leaves at time 0.
    pub start_m: [f64; 2],
    /// Where it must end; `start_m` if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_m: Option<[f64; 2]>,
    /// Speed.
    pub speed_mps: f64,
    /// Energy travelled per metre.
    pub travel_jpm: f64,
    /// Charging power.
    pub transfer_w: f64,
    /// Bound on energy delivered plus energy travelled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity_j: Option<f64>,
    /// Bound on the time at which the charger reaches `end_m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timespan_s: Option<f64>,
}

/// The field `coverage`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoverageDocument {
    /// Every point of the field stays covered by at least this many sensors.
    pub k: f64,
    /// Corners of the field, either orientation, not closed.
    pub field_m: Vec<[f64; 2]>,
}

/// An item of `sensors`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorDocument {
    /// Unique and non-empty, at most 128 bytes.
    pub id: String,
    /// Fixed place; exactly one of this and `trajectory`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<[f64; 2]>,
    /// Rows `[t, x, y]`, `t` strictly rising.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trajectory: Option<Vec<[f64; 3]>>,
    /// Radius of the closed sensing disk.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range_m: Option<f64>,
    /// Capacity of the battery.
    pub battery_j: f64,
}

/// An item of `requests`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RequestDocument {
    /// The id of a sensor.
    pub sensor: String,
    /// Charging may not begin before it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ready_s: Option<f64>,
    /// Charging must begin at or before it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deadline_s: Option<f64>,
    /// Energy left at time 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_j: Option<f64>,
    /// Consumption.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drain_w: Option<f64>,
    /// What serving it is worth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reward: Option<f64>,
    /// The tour must serve it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required: Option<bool>,
}

/// The field `travel`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TravelDocument {
    /// Square matrix over start, end and the requests in document order.
    pub distance_m: Vec<Vec<f64>>,
}
