//! Each kind of bad input gets the path of its field; good input comes back as it went.

use prost_types::Timestamp as Time;

use super::*;
use crate::domain::{Call, Refusal};
use crate::proto;

fn fields<T: std::fmt::Debug>(read: Result<T, Refusal>) -> Vec<String> {
    match read {
        Err(Refusal::Invalid(violations)) => violations.into_iter().map(|v| v.field).collect(),
        other => panic!("not refused as invalid: {other:?}"),
    }
}

fn time(seconds: i64) -> Option<Time> {
    Some(Time { seconds, nanos: 5_000 })
}

fn point() -> Option<proto::Point> {
    Some(proto::Point { x_m: 1.5, y_m: -2.0 })
}

fn at_rest() -> Option<proto::Place> {
    Some(proto::Place { place: point().map(proto::place::Place::PositionM) })
}

fn moving(times: &[i64]) -> Option<proto::Place> {
    let waypoint = |&seconds: &i64| proto::Waypoint { time: time(seconds), position_m: point() };
    let trajectory = proto::Trajectory { waypoints: times.iter().map(waypoint).collect() };
    Some(proto::Place { place: Some(proto::place::Place::Trajectory(trajectory)) })
}

fn submit() -> proto::SubmitRequest {
    proto::SubmitRequest {
        client_id: "c:1".to_owned(),
        network_id: "north".to_owned(),
        sensor_id: "Fühler <1>".to_owned(),
        place: moving(&[10, 20]),
        deadline: time(5_000),
        ready: time(4_000),
        residual_j: Some(0.0),
        measured_at: time(3_000),
        drain_w: Some(0.25),
        reward: None,
        required: true,
    }
}

fn put() -> proto::PutNetworkRequest {
    let sensor = |id: &str| proto::Sensor {
        id: id.to_owned(),
        place: at_rest(),
        range_m: Some(10.0),
        battery_j: 100.0,
        drain_w: None,
    };
    let charger = proto::ChargerType {
        name: "truck".to_owned(),
        speed_mps: 5.0,
        travel_jpm: 0.0,
        transfer_w: 20.0,
        capacity_j: Some(0.0),
        timespan_s: None,
        start_m: point(),
        end_m: None,
    };
    proto::PutNetworkRequest {
        client_id: "c".to_owned(),
        network_id: "north".to_owned(),
        spec: Some(proto::NetworkSpec {
            objective: proto::Objective::MinDistance.into(),
            charge_level: Some(1.0),
            coverage: Some(proto::Coverage { k: 1, field_m: point().into_iter().collect() }),
            charger_types: vec![charger],
            sensors: vec![sensor("s1"), sensor("s2")],
        }),
        expected_version: None,
    }
}

#[test]
fn good_messages_come_back_as_they_went() {
    let Call { client_id, content } = new_request(submit()).unwrap();
    assert_eq!(new_request_to_wire(&client_id, content), submit());
    let content = put_network(put()).unwrap().content;
    assert_eq!(Some(spec_to_wire(&content.spec)), put().spec);
    let announce = proto::AnnounceRequest {
        client_id: "c".to_owned(),
        network_id: "north".to_owned(),
        charger_id: "truck-1".to_owned(),
        charger_type: String::new(),
        t0: time(9),
        start_m: point(),
        end_m: None,
        capacity_j: Some(1.0),
        timespan_s: None,
    };
    let Call { client_id, content } = announcement(announce.clone()).unwrap();
    assert_eq!(announcement_to_wire(&client_id, content), announce);
}

#[test]
fn every_bad_field_of_a_request_is_named_at_once() {
    let bad = proto::SubmitRequest {
        client_id: String::new(),
        network_id: "no rth".to_owned(),
        sensor_id: "x".repeat(129),
        place: Some(proto::Place { place: None }),
        deadline: Some(Time { seconds: 1, nanos: -1 }),
        ready: Some(Time { seconds: -1, nanos: 0 }),
        residual_j: Some(f64::NAN),
        measured_at: Some(Time { seconds: 253_402_300_800, nanos: 0 }),
        drain_w: Some(-1.0),
        reward: Some(f64::INFINITY),
        required: false,
    };
    let expected = [
        "client_id",
        "network_id",
        "sensor_id",
        "place",
        "deadline.nanos",
        "ready.seconds",
        "measured_at.seconds",
        "residual_j",
        "drain_w",
        "reward",
    ];
    assert_eq!(fields(new_request(bad)), expected);
}

#[test]
fn a_bad_place_is_named_down_to_the_coordinate() {
    let bad = |place| fields(new_request(proto::SubmitRequest { place, ..submit() }));
    let nan = proto::Point { x_m: f64::NAN, y_m: f64::NEG_INFINITY };
    let place = proto::Place { place: Some(proto::place::Place::PositionM(nan)) };
    assert_eq!(bad(Some(place)), ["place.position_m.x_m", "place.position_m.y_m"]);
    assert_eq!(bad(moving(&[])), ["place.trajectory.waypoints"]);
    assert_eq!(bad(moving(&[1, 3, 3])), ["place.trajectory.waypoints[2].time"]);
    let waypoints = vec![proto::Waypoint::default()];
    let place = proto::place::Place::Trajectory(proto::Trajectory { waypoints });
    let missing = bad(Some(proto::Place { place: Some(place) }));
    let at = "place.trajectory.waypoints[0]";
    assert_eq!(missing, [format!("{at}.position_m"), format!("{at}.time")]);
}

#[test]
fn a_request_cannot_be_ready_after_its_deadline() {
    let bad = proto::SubmitRequest { ready: time(6_000), ..submit() };
    assert_eq!(fields(new_request(bad)), ["ready"]);
}

#[test]
fn every_bad_field_of_a_network_is_named_at_once() {
    let mut bad = put();
    let spec = bad.spec.as_mut().unwrap();
    spec.objective = 77;
    spec.charge_level = Some(1.1);
    spec.coverage = Some(proto::Coverage { k: 0, field_m: vec![] });
    spec.charger_types[0] = proto::ChargerType {
        name: "ä".to_owned(),
        capacity_j: Some(-1.0),
        travel_jpm: -1.0,
        ..proto::ChargerType::default()
    };
    spec.sensors[1] = proto::Sensor { range_m: Some(0.0), ..proto::Sensor::default() };
    let expected = [
        "spec.objective",
        "spec.charge_level",
        "spec.coverage.k",
        "spec.charger_types[0].name",
        "spec.charger_types[0].speed_mps",
        "spec.charger_types[0].travel_jpm",
        "spec.charger_types[0].transfer_w",
        "spec.charger_types[0].capacity_j",
        "spec.charger_types[0].start_m",
        "spec.sensors[1].id",
        "spec.sensors[1].place",
        "spec.sensors[1].range_m",
        "spec.sensors[1].battery_j",
    ];
    assert_eq!(fields(put_network(bad)), expected);
    assert_eq!(fields(put_network(proto::PutNetworkRequest { spec: None, ..put() })), ["spec"]);
}

#[test]
fn a_network_wrong_in_every_sensor_is_refused_briefly() {
    let mut bad = put();
    bad.spec.as_mut().unwrap().sensors = vec![proto::Sensor::default(); 10_000];
    assert!(fields(put_network(bad)).len() < 100);
}

#[test]
fn bad_fields_of_the_other_calls_are_named() {
    let visit = proto::ReportVisitRequest {
        client_id: "c".to_owned(),
        tour_id: "not-a-uuid".to_owned(),
        sensor_id: String::new(),
        outcome: 0,
        arrived_at: time(9),
        departed_at: time(8),
        charge_j: Some(-0.5),
        note: "x".repeat(1025),
    };
    let expected = ["tour_id", "sensor_id", "outcome", "departed_at", "charge_j", "note"];
    assert_eq!(fields(new_visit(visit)), expected);
    let announce = proto::AnnounceRequest {
        start_m: Some(proto::Point { x_m: 0.0, y_m: f64::NAN }),
        timespan_s: Some(-1.0),
        charger_type: "two words".to_owned(),
        ..proto::AnnounceRequest::default()
    };
    let expected =
        ["client_id", "network_id", "charger_id", "charger_type", "start_m.y_m", "timespan_s"];
    assert_eq!(fields(announcement(announce)), expected);
    let update = proto::UpdateTrajectoryRequest {
        client_id: "c".to_owned(),
        network_id: "n".to_owned(),
        trajectories: vec![proto::SensorTrajectory::default()],
    };
    assert_eq!(
        fields(trajectories(update)),
        ["trajectories[0].sensor_id", "trajectories[0].trajectory"]
    );
}

#[test]
fn times_are_cut_to_microseconds() {
    let mut fields = Fields::default();
    let read = fields.time(Path::ROOT, Time { seconds: 1, nanos: 999_999_999 }).unwrap();
    assert_eq!(time_to_wire(read), Time { seconds: 1, nanos: 999_999_000 });
}

#[test]
fn minus_zero_is_zero() {
    let bits = |residual_j| {
        let wire = proto::SubmitRequest { residual_j, ..submit() };
        new_request(wire).unwrap().content.residual_j.map(f64::to_bits)
    };
    assert_eq!(bits(Some(-0.0)), bits(Some(0.0)));
}
