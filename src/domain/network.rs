//! A network: the standing part of its scenarios.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use voltour_solver::scenario::Objective;

use super::{NetworkId, SensorId};

/// The standing part of the scenarios of a network. Units are in the field names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkSpec {
    /// What its tours optimise.
    pub objective: Objective,
    /// Fraction of the battery to charge to; 1 if none.
    pub charge_level: Option<f64>,
    /// The coverage constraint.
    pub coverage: Option<Coverage>,
    /// At least one.
    pub charger_types: Vec<ChargerType>,
    /// Its sensors.
    pub sensors: Vec<Sensor>,
}

/// Every point of the field stays covered by at least `k` sensors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// At least 1.
    pub k: u32,
    /// Corners of a simple polygon.
    pub field_m: Vec<[f64; 2]>,
}

/// A kind of charger.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChargerType {
    /// Unique in the network; spelled like a charger id.
    pub name: String,
    /// Speed.
    pub speed_mps: f64,
    /// Energy travelled per metre.
    pub travel_jpm: f64,
    /// Charging power.
    pub transfer_w: f64,
    /// Bound on energy delivered plus energy travelled.
    pub capacity_j: Option<f64>,
    /// Bound on the time from departure to the end.
    pub timespan_s: Option<f64>,
    /// Where it leaves.
    pub start_m: [f64; 2],
    /// Where it must end; `start_m` if none.
    pub end_m: Option<[f64; 2]>,
}

/// A sensor as it is registered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensor {
    /// Unique in the network.
    pub id: SensorId,
    /// Where it is unless a request or an update says otherwise.
    pub place: Place,
    /// Radius of its sensing disk.
    pub range_m: Option<f64>,
    /// Capacity of its battery.
    pub battery_j: f64,
    /// Consumption, where a request does not say otherwise.
    pub drain_w: Option<f64>,
}

/// Where a sensor is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// At rest.
    PositionM([f64; 2]),
    /// Moving.
    Trajectory(Vec<TimedPoint>),
}

/// A waypoint at an absolute time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedPoint {
    /// When.
    pub time: Timestamp,
    /// Where.
    pub position_m: [f64; 2],
}

/// A network as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Network {
    /// Made by the client.
    pub id: NetworkId,
    /// From 1.
    pub version: u64,
    /// When it was first put.
    pub created_at: Timestamp,
    /// When it was last put.
    pub updated_at: Timestamp,
    /// Sensors in `spec`.
    pub sensor_count: u32,
    /// Left out in lists.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spec: Option<NetworkSpec>,
}
