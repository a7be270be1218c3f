//! Each rule of what comes in, by the path that its violation names.

use jiff::Timestamp;

use super::*;
use crate::clock::{Clock, ManualClock, minus, plus};
use crate::domain::{
    Announcement, Coverage, NetworkSpec, NewRequest, Outcome, Place, TimedPoint, TourId,
};
use crate::store::fixture::{asks, leaves, report, spec};
use std::time::Duration;

fn now() -> Timestamp {
    ManualClock::new("2026-01-01T00:00:00Z".parse().unwrap()).now()
}

fn fields<T: std::fmt::Debug>(result: Result<T, Refusal>) -> Vec<String> {
    match result {
        Ok(_) => Vec::new(),
        Err(Refusal::Invalid(violations)) => violations.into_iter().map(|v| v.field).collect(),
        Err(other) => panic!("{other:?}"),
    }
}

fn known(spec: NetworkSpec) -> KnownNetwork {
    KnownNetwork::new("net".parse().unwrap(), 1, spec.into())
}

fn path(points: &[(i64, f64)]) -> Vec<TimedPoint> {
    let point = |&(second, x): &(i64, f64)| TimedPoint {
        time: Timestamp::from_second(second).unwrap(),
        position_m: [x, 0.0],
    };
    points.iter().map(point).collect()
}

#[test]
fn a_network() {
    let broken = |change: &dyn Fn(&mut NetworkSpec)| {
        let mut spec = spec();
        change(&mut spec);
        fields(network(&spec))
    };
    assert!(broken(&|_| ()).is_empty());
    assert_eq!(broken(&|s| s.sensors[3].battery_j = 0.0), ["spec.sensors[3].battery_j"]);
    assert_eq!(broken(&|s| s.sensors[2].drain_w = Some(-1.0)), ["spec.sensors[2].drain_w"]);
    assert_eq!(
        broken(&|s| s.charger_types[0].speed_mps = f64::NAN),
        ["spec.charger_types[0].speed_mps"]
    );
    assert_eq!(broken(&|s| s.charger_types.clear()), ["spec.charger_types"]);
    assert_eq!(
        broken(&|s| s.charger_types.push(s.charger_types[0].clone())),
        ["spec.charger_types[1].name"]
    );
    assert_eq!(
        broken(&|s| s.charger_types[0].name = "a cart".into()),
        ["spec.charger_types[0].name"]
    );
    assert_eq!(broken(&|s| s.charge_level = Some(1.5)), ["spec.charge_level"]);
    let twice = |s: &mut NetworkSpec| s.sensors[4].id = s.sensors[0].id.clone();
    assert_eq!(broken(&twice), ["spec.sensors[4].id"]);
    let square = vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]];
    let covered = |k, field_m: &[[f64; 2]]| {
        let coverage = Some(Coverage { k, field_m: field_m.to_vec() });
        broken(&move |s| s.coverage = coverage.clone())
    };
    assert_eq!(covered(0, &square), ["spec.coverage.k"]);
    assert_eq!(covered(1, &square[..2]), ["spec.coverage.field_m"]);
    assert_eq!(covered(1, &square), ["spec.sensors[0].range_m"]);
}

#[test]
fn a_network_of_moving_sensors() {
    let broken = |points: &[(i64, f64)]| {
        let mut spec = spec();
        // The slowest type decides, wherever it stands.
        let mut slow = spec.charger_types[0].clone();
        (slow.name, slow.speed_mps) = ("slow".into(), 2.0);
        spec.charger_types.push(slow);
        spec.sensors[1].place = Place::Trajectory(path(points));
        fields(network(&spec))
    };
    assert!(broken(&[(0, 0.0), (10, 10.0)]).is_empty());
    let field = "spec.sensors[1].place.trajectory.waypoints[1]";
    assert_eq!(broken(&[(0, 0.0), (10, 20.0)]), [field]);
    assert_eq!(broken(&[(10, 0.0), (10, 0.0)]), [field]);
    assert_eq!(broken(&[]), ["spec.sensors[1].place.trajectory"]);
}

#[test]
fn a_request() {
    let network = known(spec());
    let broken = |change: &dyn Fn(&mut NewRequest)| {
        let mut asked = asks("s1");
        change(&mut asked);
        fields(request(&network, &asked, now()))
    };
    assert!(broken(&|_| ()).is_empty());
    assert_eq!(broken(&|r| r.sensor_id = "s9".parse().unwrap()), ["sensor_id"]);
    assert_eq!(broken(&|r| r.residual_j = Some(100.1)), ["residual_j"]);
    assert_eq!(
        broken(&|r| (r.drain_w, r.reward) = (Some(-0.1), Some(f64::INFINITY))),
        ["drain_w", "reward"]
    );
    assert_eq!(
        broken(&|r| (r.ready, r.deadline) = (Some(plus(now(), SLACK)), Some(now()))),
        ["ready"]
    );
    let ahead = |seconds| Some(plus(now(), Duration::from_secs(seconds)));
    assert!(broken(&|r| r.measured_at = ahead(30)).is_empty());
    assert_eq!(broken(&|r| r.measured_at = ahead(31)), ["measured_at"]);
    assert_eq!(
        broken(&|r| r.place = Some(Place::PositionM([f64::NAN, 0.0]))),
        ["place.position_m"]
    );
    let fast = || Some(Place::Trajectory(path(&[(0, 0.0), (1, 9.0)])));
    assert_eq!(broken(&|r| r.place = fast()), ["place.trajectory.waypoints[1]"]);
}

#[test]
fn no_trajectory_under_coverage() {
    let mut covered = spec();
    let field_m = vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]];
    covered.coverage = Some(Coverage { k: 1, field_m });
    covered.sensors.iter_mut().for_each(|sensor| sensor.range_m = Some(50.0));
    network(&covered).unwrap();
    let covered = known(covered);
    let mut asked = asks("s1");
    asked.place = Some(Place::Trajectory(path(&[(0, 0.0)])));
    assert_eq!(fields(request(&covered, &asked, now())), ["place.trajectory"]);
    let update = [("s1".parse().unwrap(), path(&[(0, 0.0)]))];
    assert_eq!(fields(trajectories(&covered, &update)), ["trajectories[0].trajectory"]);
}

#[test]
fn trajectories_that_come_later() {
    let network = known(spec());
    let update = |sensor: &str, points: &[(i64, f64)]| (sensor.parse().unwrap(), path(points));
    assert!(fields(trajectories(&network, &[update("s1", &[(0, 0.0)])])).is_empty());
    let broken = [
        update("s1", &[(0, 0.0), (1, 9.0)]),
        update("s9", &[(0, 0.0)]),
        update("s1", &[(0, 0.0)]),
        update("s2", &[]),
    ];
    assert_eq!(
        fields(trajectories(&network, &broken)),
        [
            "trajectories[0].trajectory.waypoints[1]",
            "trajectories[1].sensor_id",
            "trajectories[2].sensor_id",
            "trajectories[3].trajectory",
        ]
    );
}

#[test]
fn an_announcement() {
    let network = known(spec());
    let at = |t0| fields(announcement(&network, &leaves("c", Some(t0)), now()));
    let day = Duration::from_hours(24);
    assert!(at(minus(now(), SLACK)).is_empty());
    assert_eq!(at(minus(now(), SLACK + Duration::from_secs(1))), ["t0"]);
    assert!(at(plus(now(), day * 7)).is_empty());
    assert_eq!(at(plus(now(), day * 7 + Duration::from_secs(1))), ["t0"]);
    let broken = Announcement {
        charger_type: Some("plane".into()),
        capacity_j: Some(-1.0),
        timespan_s: Some(f64::NAN),
        end_m: Some([0.0, f64::INFINITY]),
        ..leaves("c", None)
    };
    let found = fields(announcement(&network, &broken, now()));
    assert_eq!(found, ["end_m", "capacity_j", "timespan_s", "charger_type"]);
    let mut two = spec();
    two.charger_types.push(two.charger_types[0].clone());
    two.charger_types[1].name = "van".into();
    assert_eq!(fields(announcement(&known(two), &leaves("c", None), now())), ["charger_type"]);
}

#[test]
fn a_visit() {
    let mut visit = report(TourId(uuid::Uuid::nil()), "s1", Outcome::Charged);
    assert!(fields(super::visit(&visit)).is_empty());
    visit.note = Some("x".repeat(1025));
    visit.charge_j = Some(-1.0);
    (visit.arrived_at, visit.departed_at) = (Some(now()), Some(minus(now(), SLACK)));
    assert_eq!(fields(super::visit(&visit)), ["charge_j", "departed_at", "note"]);
    assert_eq!(fields(cancellation(&"x".repeat(257))), ["reason"]);
}

#[test]
fn a_network_has_so_many_sensors_and_no_more() {
    let with = |sensors: usize| {
        let mut spec = spec();
        let model = spec.sensors[0].clone();
        let sensor = |i: usize| {
            let mut sensor = model.clone();
            sensor.id = format!("s{i}").parse().unwrap();
            sensor
        };
        spec.sensors = (0..sensors).map(sensor).collect();
        fields(network(&spec))
    };
    assert!(with(20_000).is_empty());
    assert_eq!(with(20_001), ["spec.sensors"]);
}
