//! Of NetworkService.

use voltour::proto::{
    ChargerType, Coverage, GetNetworkRequest, ListNetworksRequest, NetworkSpec, Place, Point,
    PutNetworkRequest, SensorTrajectory, Trajectory, UpdateTrajectoryRequest, Waypoint, place,
};

use super::{NO_NUMBERS, bad_ids, refused};
use crate::app::TestApp;
use crate::field::{FIELD, at_rest, charger_type, covered, fresh, line, point, put};
use crate::time::wire;

type Edit = Box<dyn Fn(&mut NetworkSpec)>;

fn edit(change: impl Fn(&mut NetworkSpec) + 'static) -> Edit {
    Box::new(change)
}

fn path(rows: &[(i64, f64)]) -> Trajectory {
    let waypoint = |&(s, x): &(i64, f64)| Waypoint {
        time: Some(wire(s * 1_000_000)),
        position_m: point(x, 0.0),
    };
    Trajectory { waypoints: rows.iter().map(waypoint).collect() }
}

fn moving(rows: &[(i64, f64)]) -> Option<Place> {
    Some(Place { place: Some(place::Place::Trajectory(path(rows))) })
}

fn ring(corners: &[(f64, f64)]) -> Option<Coverage> {
    let field_m = corners.iter().map(|&(x_m, y_m)| Point { x_m, y_m }).collect();
    Some(Coverage { k: 1, field_m })
}

/// What may be wrong with a spec, and the field that is named.
fn bad_specs() -> Vec<(&'static str, Edit)> {
    let mut all: Vec<(&'static str, Edit)> = vec![
        ("spec.objective", edit(|s| s.objective = 0)),
        ("spec.objective", edit(|s| s.objective = 99)),
        ("spec.charge_level", edit(|s| s.charge_level = Some(0.0))),
        ("spec.charge_level", edit(|s| s.charge_level = Some(1.5))),
        ("spec.charger_types", edit(|s| s.charger_types.clear())),
        ("spec.charger_types[0].name", edit(|s| s.charger_types[0].name.clear())),
        ("spec.charger_types[1].name", edit(|s| s.charger_types.push(charger_type()))),
        ("spec.charger_types[0].speed_mps", edit(|s| s.charger_types[0].speed_mps = 0.0)),
        ("spec.charger_types[0].travel_jpm", edit(|s| s.charger_types[0].travel_jpm = -1.0)),
        ("spec.charger_types[0].transfer_w", edit(|s| s.charger_types[0].transfer_w = 0.0)),
        ("spec.charger_types[0].capacity_j", edit(|s| s.charger_types[0].capacity_j = Some(-1.0))),
        ("spec.charger_types[0].timespan_s", edit(|s| s.charger_types[0].timespan_s = Some(-1.0))),
        ("spec.charger_types[0].start_m", edit(|s| s.charger_types[0].start_m = None)),
        ("spec.sensors[1].id", edit(|s| s.sensors[1].id = "s1".into())),
        ("spec.sensors[0].id", edit(|s| s.sensors[0].id.clear())),
        ("spec.sensors[0].id", edit(|s| s.sensors[0].id = "ä".repeat(65))),
        ("spec.sensors[1].place", edit(|s| s.sensors[1].place = None)),
        ("spec.sensors[1].place", edit(|s| s.sensors[1].place = Some(Place { place: None }))),
        ("spec.sensors[2].battery_j", edit(|s| s.sensors[2].battery_j = 0.0)),
        ("spec.sensors[2].drain_w", edit(|s| s.sensors[2].drain_w = Some(-0.1))),
        ("spec.sensors[2].range_m", edit(|s| s.sensors[2].range_m = Some(0.0))),
        ("spec.sensors[0].place.trajectory.waypoints", edit(|s| s.sensors[0].place = moving(&[]))),
        (
            "spec.sensors[0].place.trajectory.waypoints[1].time",
            edit(|s| s.sensors[0].place = moving(&[(5, 0.0), (5, 1.0)])),
        ),
        ("spec.coverage.k", edit(|s| *s = with_k(0))),
        ("spec.coverage.field_m", edit(|s| cover(s, &[(0.0, 0.0), (1.0, 0.0)]))),
        (
            "spec.coverage.field_m",
            edit(|s| cover(s, &[(0.0, 0.0), (9.0, 9.0), (9.0, 0.0), (0.0, 9.0)])),
        ),
        (
            "spec.sensors[1].range_m",
            edit(|s| {
                *s = covered(3, 1);
                s.sensors[1].range_m = None;
            }),
        ),
    ];
    for value in NO_NUMBERS {
        all.extend([
            ("spec.charge_level", edit(move |s| s.charge_level = Some(value))),
            ("spec.sensors[0].battery_j", edit(move |s| s.sensors[0].battery_j = value)),
            (
                "spec.sensors[0].place.position_m.x_m",
                edit(move |s| s.sensors[0].place = at_rest(value, 0.0)),
            ),
            (
                "spec.charger_types[0].end_m.y_m",
                edit(move |s| s.charger_types[0].end_m = point(0.0, value)),
            ),
        ]);
    }
    all
}

fn with_k(k: u32) -> NetworkSpec {
    let mut spec = covered(3, 1);
    spec.coverage.as_mut().unwrap().k = k;
    spec
}

fn cover(spec: &mut NetworkSpec, corners: &[(f64, f64)]) {
    *spec = covered(3, 1);
    spec.coverage = ring(corners);
}

#[tokio::test]
async fn put_names_the_field() {
    let app = TestApp::start().await;
    for (field, change) in bad_specs() {
        let mut spec = line(3);
        change(&mut spec);
        refused(app.networks().put(put(spec)).await, field);
    }
    for id in bad_ids() {
        let call = PutNetworkRequest { network_id: id.clone(), ..put(line(1)) };
        refused(app.networks().put(call).await, "network_id");
        let call = PutNetworkRequest { client_id: id.clone(), ..put(line(1)) };
        refused(app.networks().put(call).await, "client_id");
        refused(app.networks().get(GetNetworkRequest { network_id: id }).await, "network_id");
    }
    refused(app.networks().put(PutNetworkRequest { spec: None, ..put(line(1)) }).await, "spec");
    let listed = app.networks().list(ListNetworksRequest::default()).await.unwrap().into_inner();
    assert!(listed.networks.is_empty(), "nothing of a refused call is stored");
}

#[tokio::test]
async fn every_broken_rule_is_named_at_once() {
    let app = TestApp::start().await;
    let mut spec = line(2);
    spec.sensors[0].battery_j = -1.0;
    spec.sensors[1].drain_w = Some(f64::NAN);
    spec.charger_types[0].transfer_w = 0.0;
    let call = PutNetworkRequest { client_id: "no id".into(), ..put(spec) };
    let mut named = super::violations(&app.networks().put(call).await.unwrap_err());
    named.sort();
    let expected = [
        "client_id",
        "spec.charger_types[0].transfer_w",
        "spec.sensors[0].battery_j",
        "spec.sensors[1].drain_w",
    ];
    assert_eq!(named, expected);
}

#[tokio::test]
async fn a_sensor_must_be_slower_than_every_charger() {
    let app = TestApp::start().await;
    let mut spec = line(2);
    spec.charger_types.push(ChargerType {
        name: "bicycle".into(),
        speed_mps: 4.0,
        ..charger_type()
    });
    spec.sensors[1].place = moving(&[(0, 0.0), (10, 30.0), (20, 80.0)]);
    let status = app.networks().put(put(spec)).await.unwrap_err();
    let named = super::violations(&status);
    assert!(named[0].starts_with("spec.sensors[1].place.trajectory"), "{named:?}");
    // Fast enough for 3 m/s, not for 5.
    let mut spec = line(2);
    spec.sensors[1].place = moving(&[(0, 0.0), (10, 30.0), (20, 80.0)]);
    app.put(spec).await;
}

#[tokio::test]
async fn coverage_and_trajectories_exclude_each_other() {
    let app = TestApp::start().await;
    let mut spec = covered(2, 1);
    spec.sensors[1].place = moving(&[(0, 0.0)]);
    let named = super::violations(&app.networks().put(put(spec)).await.unwrap_err());
    let fits = |f: &String| f == "spec.coverage" || f.starts_with("spec.sensors[1].place");
    assert!(named.len() == 1 && named.iter().all(fits), "{named:?}");
}

#[tokio::test]
async fn update_trajectory_names_the_field() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let one = |sensor: &str, trajectory: Option<Trajectory>| UpdateTrajectoryRequest {
        client_id: fresh("move"),
        network_id: FIELD.into(),
        trajectories: vec![
            SensorTrajectory { sensor_id: "s1".into(), trajectory: Some(path(&[(0, 0.0)])) },
            SensorTrajectory { sensor_id: sensor.into(), trajectory },
        ],
    };
    let fine = || Some(path(&[(0, 0.0), (10, 5.0)]));
    for (field, call) in [
        ("trajectories[1].sensor_id", one("", fine())),
        ("trajectories[1].sensor_id", one("unknown", fine())),
        ("trajectories[1].sensor_id", one("s1", fine())),
        ("trajectories[1].trajectory", one("s2", None)),
        ("trajectories[1].trajectory.waypoints", one("s2", Some(path(&[])))),
        (
            "trajectories[1].trajectory.waypoints[1].time",
            one("s2", Some(path(&[(3, 0.0), (2, 0.0)]))),
        ),
        (
            "trajectories[1].trajectory.waypoints[0].position_m.x_m",
            one("s2", Some(path(&[(0, f64::NAN)]))),
        ),
        ("client_id", UpdateTrajectoryRequest { client_id: String::new(), ..one("s2", fine()) }),
    ] {
        refused(app.networks().update_trajectory(call).await, field);
    }
    let fast = one("s2", Some(path(&[(0, 0.0), (1, 50.0)])));
    let status = app.networks().update_trajectory(fast).await.unwrap_err();
    let named = super::violations(&status);
    assert!(named[0].starts_with("trajectories[1].trajectory"), "{named:?}");
    let elsewhere = UpdateTrajectoryRequest { network_id: "nowhere".into(), ..one("s2", fine()) };
    let status = app.networks().update_trajectory(elsewhere).await.unwrap_err();
    assert_eq!(status.code(), tonic::Code::NotFound);
}
