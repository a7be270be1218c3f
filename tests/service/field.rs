//! The network that most tests use, and messages with only the fields that every call needs.
//!
//! Sensors `s1`, `s2`, ... stand on a line, 10 m apart, beginning at 10 m; the charger leaves the origin
//! with 10 m/s, pays 1 J/m and charges with 20 W a battery of 100 J. Nothing bounds a tour, so every
//! request is a stop unless a test says otherwise.

use std::sync::atomic::{AtomicU64, Ordering};

use voltour::proto::place::Place as Kind;
use voltour::proto::{
    AnnounceRequest, CancelDepartureRequest, ChargerType, CompleteRequest, Coverage, NetworkSpec,
    Objective, Place, Point, PutNetworkRequest, ReportVisitRequest, Sensor, SubmitRequest,
    VisitOutcome, WithdrawRequest,
};

/// The network of a test.
pub const FIELD: &str = "field";

/// A client id that was never used.
pub fn fresh(what: &str) -> String {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    format!("{what}-{}", NEXT.fetch_add(1, Ordering::Relaxed))
}

pub fn point(x_m: f64, y_m: f64) -> Option<Point> {
    Some(Point { x_m, y_m })
}

pub fn at_rest(x_m: f64, y_m: f64) -> Option<Place> {
    Some(Place { place: Some(Kind::PositionM(Point { x_m, y_m })) })
}

pub fn sensor(number: usize) -> Sensor {
    Sensor {
        id: format!("s{number}"),
        place: at_rest(10.0 * number as f64, 0.0),
        range_m: None,
        battery_j: 100.0,
        drain_w: None,
    }
}

pub fn charger_type() -> ChargerType {
    ChargerType {
        name: "truck".into(),
        speed_mps: 10.0,
        travel_jpm: 1.0,
        transfer_w: 20.0,
        capacity_j: None,
        timespan_s: None,
        start_m: point(0.0, 0.0),
        end_m: None,
    }
}

/// A line of so many sensors.
pub fn line(sensors: usize) -> NetworkSpec {
    NetworkSpec {
        objective: Objective::MaxReward as i32,
        charge_level: None,
        coverage: None,
        charger_types: vec![charger_type()],
        sensors: (1..=sensors).map(sensor).collect(),
    }
}

/// A line of sensors whose disks all cover one small square: any `k` of them do.
pub fn covered(sensors: usize, k: u32) -> NetworkSpec {
    let corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (0.0, 5.0)];
    let mut spec = line(sensors);
    spec.objective = Objective::MinDistance as i32;
    spec.coverage =
        Some(Coverage { k, field_m: corners.map(|(x_m, y_m)| Point { x_m, y_m }).to_vec() });
    for sensor in &mut spec.sensors {
        sensor.range_m = Some(1000.0);
    }
    spec
}

pub fn put(spec: NetworkSpec) -> PutNetworkRequest {
    PutNetworkRequest {
        client_id: fresh("put"),
        network_id: FIELD.into(),
        spec: Some(spec),
        expected_version: None,
    }
}

pub fn request(sensor: &str) -> SubmitRequest {
    SubmitRequest {
        client_id: fresh("request"),
        network_id: FIELD.into(),
        sensor_id: sensor.into(),
        ..SubmitRequest::default()
    }
}

pub fn withdrawal(request_id: &str) -> WithdrawRequest {
    WithdrawRequest {
        client_id: fresh("withdraw"),
        network_id: FIELD.into(),
        request_id: request_id.into(),
    }
}

/// As soon as can be.
pub fn departure(charger: &str) -> AnnounceRequest {
    AnnounceRequest {
        client_id: fresh("announce"),
        network_id: FIELD.into(),
        charger_id: charger.into(),
        ..AnnounceRequest::default()
    }
}

pub fn cancellation(departure_id: &str) -> CancelDepartureRequest {
    CancelDepartureRequest {
        client_id: fresh("cancel"),
        departure_id: departure_id.into(),
        reason: "the charger broke down".into(),
    }
}

pub fn visit(tour_id: &str, sensor: &str, outcome: VisitOutcome) -> ReportVisitRequest {
    ReportVisitRequest {
        client_id: fresh("visit"),
        tour_id: tour_id.into(),
        sensor_id: sensor.into(),
        outcome: outcome as i32,
        ..ReportVisitRequest::default()
    }
}

pub fn completion(tour_id: &str) -> CompleteRequest {
    CompleteRequest { client_id: fresh("complete"), tour_id: tour_id.into() }
}
