//! Networks.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;

use crate::domain;

/// A network
#[derive(Debug, Serialize, ToSchema)]
pub(in crate::rest) struct Network {
    id: String,
    /// Rises with every change, from 1
    version: u64,
    created_at: Timestamp,
    updated_at: Timestamp,
    sensor_count: u32,
    /// Left out in lists
    #[serde(skip_serializing_if = "Option::is_none")]
    spec: Option<NetworkSpec>,
}

/// The standing part of a network's scenarios
#[derive(Debug, Serialize, ToSchema)]
struct NetworkSpec {
    /// `min_distance`, `max_reward` or `max_count`
    objective: &'static str,
    /// Fraction of the battery to charge to; 1 if null
    charge_level: Option<f64>,
    coverage: Option<Coverage>,
    charger_types: Vec<ChargerType>,
    sensors: Vec<Sensor>,
}

/// Every point of the field stays covered by at least `k` sensors
#[derive(Debug, Serialize, ToSchema)]
struct Coverage {
    k: u32,
    /// Corners of a simple polygon
    field_m: Vec<[f64; 2]>,
}

/// A kind of charger
#[derive(Debug, Serialize, ToSchema)]
struct ChargerType {
    name: String,
    speed_mps: f64,
    travel_jpm: f64,
    transfer_w: f64,
    capacity_j: Option<f64>,
    timespan_s: Option<f64>,
    start_m: [f64; 2],
    /// `start_m` if null
    end_m: Option<[f64; 2]>,
}

/// A sensor as it is registered
#[derive(Debug, Serialize, ToSchema)]
struct Sensor {
    /// Free text
    id: String,
    #[serde(flatten)]
    place: Place,
    range_m: Option<f64>,
    battery_j: f64,
    drain_w: Option<f64>,
}

/// Where a sensor is: one of the two, the other null
#[derive(Debug, Default, Serialize, ToSchema)]
pub(in crate::rest) struct Place {
    position_m: Option<[f64; 2]>,
    trajectory: Option<Vec<TimedPoint>>,
}

/// A waypoint
#[derive(Debug, Serialize, ToSchema)]
struct TimedPoint {
    time: Timestamp,
    position_m: [f64; 2],
}

impl From<domain::Network> for Network {
    fn from(network: domain::Network) -> Self {
        Self {
            id: network.id.into(),
            version: network.version,
            created_at: network.created_at,
            updated_at: network.updated_at,
            sensor_count: network.sensor_count,
            spec: network.spec.map(Into::into),
        }
    }
}

impl From<domain::NetworkSpec> for NetworkSpec {
    fn from(spec: domain::NetworkSpec) -> Self {
        let coverage = |c: domain::Coverage| Coverage { k: c.k, field_m: c.field_m };
        Self {
            objective: spec.objective.name(),
            charge_level: spec.charge_level,
            coverage: spec.coverage.map(coverage),
            charger_types: spec.charger_types.into_iter().map(Into::into).collect(),
            sensors: spec.sensors.into_iter().map(Into::into).collect(),
        }
    }
}

impl From<domain::ChargerType> for ChargerType {
    fn from(kind: domain::ChargerType) -> Self {
        Self {
            name: kind.name,
            speed_mps: kind.speed_mps,
            travel_jpm: kind.travel_jpm,
            transfer_w: kind.transfer_w,
            capacity_j: kind.capacity_j,
            timespan_s: kind.timespan_s,
            start_m: kind.start_m,
            end_m: kind.end_m,
        }
    }
}

impl From<domain::Sensor> for Sensor {
    fn from(sensor: domain::Sensor) -> Self {
        Self {
            id: sensor.id.into(),
            place: sensor.place.into(),
            range_m: sensor.range_m,
            battery_j: sensor.battery_j,
            drain_w: sensor.drain_w,
        }
    }
}

impl From<domain::Place> for Place {
    fn from(place: domain::Place) -> Self {
        let point = |p: domain::TimedPoint| TimedPoint { time: p.time, position_m: p.position_m };
        match place {
            domain::Place::PositionM(at) => Self { position_m: Some(at), trajectory: None },
            domain::Place::Trajectory(points) => {
                let points = points.into_iter().map(point).collect();
                Self { position_m: None, trajectory: Some(points) }
            }
        }
    }
}
