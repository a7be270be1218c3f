//! From the service's words to those of the scenario document: metres, and seconds after a second 0.

use jiff::Timestamp;
use voltour_solver::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, SensorDocument,
};

use super::{ChargerType, Coverage, NetworkSpec, Place, Sensor, TimedPoint};
use crate::clock::seconds;

/// The scenario of a network without its sensors and requests.
pub fn document(spec: &NetworkSpec, charger: ChargerDocument) -> Document {
    Document {
        format: FORMAT.to_owned(),
        name: None,
        objective: spec.objective,
        charger,
        charge_level: spec.charge_level,
        coverage: spec.coverage.as_ref().map(coverage),
        sensors: Vec::new(),
        requests: Vec::new(),
        travel: None,
    }
}

fn coverage(coverage: &Coverage) -> CoverageDocument {
    CoverageDocument { k: f64::from(coverage.k), field_m: coverage.field_m.clone() }
}

/// A charger of a type.
pub fn charger(kind: &ChargerType) -> ChargerDocument {
    ChargerDocument {
        start_m: kind.start_m,
        end_m: kind.end_m,
        speed_mps: kind.speed_mps,
        travel_jpm: kind.travel_jpm,
        transfer_w: kind.transfer_w,
        capacity_j: kind.capacity_j,
        timespan_s: kind.timespan_s,
    }
}

/// A sensor at a place, with `start` as second 0.
pub fn sensor(sensor: &Sensor, place: &Place, start: Timestamp) -> SensorDocument {
    let (position_m, trajectory) = match place {
        Place::PositionM(position) => (Some(*position), None),
        Place::Trajectory(points) => (None, Some(rows(points, start))),
    };
    SensorDocument {
        id: sensor.id.to_string(),
        position_m,
        trajectory,
        range_m: sensor.range_m,
        battery_j: sensor.battery_j,
    }
}

fn rows(points: &[TimedPoint], start: Timestamp) -> Vec<[f64; 3]> {
    let row =
        |point: &TimedPoint| [seconds(start, point.time), point.position_m[0], point.position_m[1]];
    points.iter().map(row).collect()
}
