//! Generated scenarios: the same for good, as the paper describes them, and refusing bad options.

use voltour_solver::generate::{
    GenerateError, KCoverage, Mobile, Reward, k_coverage, mobile, reward,
};
use voltour_solver::scenario::{Document, Place, Scenario};

/// FNV-1a over the document's JSON.
fn fingerprint(document: &Document) -> u64 {
    let text = serde_json::to_string(document).expect("documents are JSON");
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

fn scenario(document: &Document) -> Scenario {
    let text = serde_json::to_string(document).expect("documents are JSON");
    Scenario::from_json(text.as_bytes()).expect("generated scenarios are valid")
}

#[test]
fn documents_never_change() {
    let easy = KCoverage { sensors: 64, k: 1, ..KCoverage::default() };
    let found = [
        reward(&Reward::default(), 0),
        reward(&Reward::default(), 1),
        mobile(&Mobile::default(), 0),
        mobile(&Mobile::default(), u64::MAX),
        k_coverage(&easy, 7),
        k_coverage(&KCoverage::default(), 7),
    ];
    let found = found.map(|document| format!("{:016x}", fingerprint(&document.expect("drawn"))));
    let frozen = [
        "002c2fec968955da",
        "ceb7cb04dfb6d3d0",
        "6dba63aab759b031",
        "30b3a9bb415a47a5",
        "b79ba09dc72e4c4d",
        "17800e9d0949661c",
    ];
    assert_eq!(found, frozen);
}

#[test]
fn k_coverage_is_as_the_paper_describes() {
    let options = KCoverage { sensors: 80, k: 2, ..KCoverage::default() };
    for seed in 0..20 {
        let document = k_coverage(&options, seed).unwrap();
        assert_eq!(document.name, Some(format!("k_coverage-n80-k2-a0.45-s{seed}")));
        let scenario = scenario(&document);
        assert_eq!(scenario.charger.start_m, [250.0, 250.0].into());
        assert_eq!(scenario.charger.end_m, scenario.charger.start_m);
        assert_eq!((scenario.sensors.len(), scenario.coverage.as_ref().unwrap().k), (80, 2));
        assert!(scenario.requests.len() > 15 && scenario.requests.len() < 55);
        for request in &scenario.requests {
            assert!(request.residual_j > 540.0 && request.residual_j <= 0.45 * 10_800.0);
            assert!((0.2..=0.6).contains(&request.drain_w));
            let empty_s = request.residual_j / request.drain_w;
            assert!((request.deadline_s.unwrap() - empty_s).abs() < 1e-6);
        }
        let regions = voltour_solver::coverage::regions(&scenario);
        assert!(regions.iter().all(|region| region.covering.len() >= 2));
        // And by points, for what it is worth.
        for (i, j) in (0..=40).flat_map(|i| (0..=40).map(move |j| (f64::from(i), f64::from(j)))) {
            let at = [i * 12.5, j * 12.5].into();
            let near = |place: &Place| nalgebra::distance(&place.at(0.0), &at) <= 135.0;
            assert!(scenario.sensors.iter().filter(|s| near(&s.place)).count() >= 2);
        }
    }
}

#[test]
fn reward_is_as_the_paper_describes() {
    let mut asking = 0;
    for seed in 0..20 {
        let document = reward(&Reward::default(), seed).unwrap();
        assert_eq!(document.name, Some(format!("reward-n100-a0.2-s{seed}")));
        let scenario = scenario(&document);
        assert_eq!(scenario.charger.capacity_j, Some(300_000.0));
        assert_eq!(scenario.charger.start_m, [500.0, 500.0].into());
        asking += scenario.requests.len();
        for request in &scenario.requests {
            assert!(request.residual_j > 0.0 && request.residual_j < 2160.0);
            assert_eq!((request.drain_w, request.deadline_s), (0.0, None));
            assert_eq!(request.reward, 10_800.0 - request.residual_j);
        }
    }
    assert!((300..500).contains(&asking), "a fifth of 2,000: {asking}");
    let all = Reward { alpha: 1.0, ..Reward::default() };
    assert_eq!(reward(&all, 3).unwrap().requests.len(), 100);
}

#[test]
fn mobile_is_as_the_paper_describes() {
    for seed in 0..20 {
        let document = mobile(&Mobile::default(), seed).unwrap();
        let scenario = scenario(&document);
        assert_eq!(scenario.charge_level, 0.81);
        assert_eq!(scenario.charger.timespan_s, Some(1800.0));
        assert_eq!(scenario.charger.end_m, [100.0, 100.0].into());
        assert_eq!(scenario.requests.len(), 20);
        for sensor in &scenario.sensors {
            let Place::Moving(trajectory) = &sensor.place else { panic!("{sensor:?} rests") };
            let rows = trajectory.waypoints();
            assert!(rows[0].time_s == 0.0 && rows[rows.len() - 1].time_s >= 1800.0);
            let speed = |pair: &[voltour_solver::scenario::Waypoint]| {
                let metres = (pair[1].position_m - pair[0].position_m).norm();
                metres / (pair[1].time_s - pair[0].time_s)
            };
            let speeds: Vec<f64> = rows.windows(2).map(speed).collect();
            assert!(speeds.iter().all(|v| *v <= 2.001 && (v - speeds[0]).abs() < 1e-3));
            let inside = |x: f64| (0.0..=100.0).contains(&x);
            assert!(rows.iter().all(|w| inside(w.position_m.x) && inside(w.position_m.y)));
        }
    }
}

#[test]
fn sensors_may_rest() {
    let still = Mobile { sensor_max_mps: 0.0, ..Mobile::default() };
    let document = mobile(&still, 5).unwrap();
    assert!(document.sensors.iter().all(|s| s.trajectory.as_ref().unwrap().len() == 1));
}

#[test]
fn too_few_sensors_end_in_an_error_not_in_a_loop() {
    let options = KCoverage { sensors: 5, k: 3, attempts: 200, ..KCoverage::default() };
    let error = k_coverage(&options, 1).unwrap_err();
    assert_eq!(error, GenerateError::NotCovered { attempts: 200, sensors: 5, k: 3 });
    assert!(error.to_string().starts_with("attempts: 200: none"), "{error}");
}

#[test]
fn options_are_validated_by_name() {
    let k = KCoverage::default;
    let bad_k = [
        (KCoverage { sensors: 0, ..k() }, "sensors: 0: must be 1 to 1000000"),
        (KCoverage { k: 0, ..k() }, "k: 0: must be 1 to 1000000"),
        (KCoverage { k: 49, ..k() }, "k: 49: must be at most sensors, 48"),
        (KCoverage { alpha: 1.1, ..k() }, "alpha: 1.1: must be in [0, 1]"),
        (KCoverage { alpha: f64::NAN, ..k() }, "alpha: NaN: must be in [0, 1]"),
        (KCoverage { side_m: 0.0, ..k() }, "side_m: 0: must be 1 to 1e9 m"),
        (KCoverage { range_m: -1.0, ..k() }, "range_m: -1: must be > 0"),
        (KCoverage { battery_j: f64::INFINITY, ..k() }, "battery_j: inf: must be > 0"),
        (KCoverage { residual_above_j: -1.0, ..k() }, "residual_above_j: -1: must be >= 0"),
        (
            KCoverage { residual_above_j: 10_800.0, ..k() },
            "residual_above_j: 10800: must be less than battery_j, 10800",
        ),
        (KCoverage { drain_min_w: 0.0, ..k() }, "drain_min_w: 0: must be > 0"),
        (
            KCoverage { drain_max_w: 0.1, ..k() },
            "drain_min_w: 0.2: must be at most drain_max_w, 0.1",
        ),
        (KCoverage { speed_mps: 0.0, ..k() }, "speed_mps: 0: must be > 0"),
        (KCoverage { travel_jpm: -0.5, ..k() }, "travel_jpm: -0.5: must be >= 0"),
        (KCoverage { transfer_w: 0.0, ..k() }, "transfer_w: 0: must be > 0"),
        (KCoverage { attempts: 0, ..k() }, "attempts: 0: must be > 0"),
    ];
    for (options, line) in bad_k {
        assert_eq!(k_coverage(&options, 0).unwrap_err().to_string(), line);
    }
    let r = Reward::default;
    let bad_r = [
        (Reward { sensors: 2_000_000, ..r() }, "sensors: 2000000: must be 1 to 1000000"),
        (Reward { side_m: 2e9, ..r() }, "side_m: 2000000000: must be 1 to 1e9 m"),
        (Reward { alpha: -0.1, ..r() }, "alpha: -0.1: must be in [0, 1]"),
        (Reward { capacity_j: -1.0, ..r() }, "capacity_j: -1: must be >= 0"),
        (Reward { battery_j: 0.0, ..r() }, "battery_j: 0: must be > 0"),
        (Reward { speed_mps: -5.0, ..r() }, "speed_mps: -5: must be > 0"),
        (Reward { travel_jpm: f64::NAN, ..r() }, "travel_jpm: NaN: must be >= 0"),
        (Reward { transfer_w: 0.0, ..r() }, "transfer_w: 0: must be > 0"),
    ];
    for (options, line) in bad_r {
        assert_eq!(reward(&options, 0).unwrap_err().to_string(), line);
    }
    let m = Mobile::default;
    let bad_m = [
        (Mobile { sensors: 0, ..m() }, "sensors: 0: must be 1 to 1000000"),
        (Mobile { timespan_s: 0.0, ..m() }, "timespan_s: 0: must be > 0"),
        (Mobile { sensor_min_mps: -1.0, ..m() }, "sensor_min_mps: -1: must be >= 0"),
        (
            Mobile { sensor_min_mps: 2.5, ..m() },
            "sensor_min_mps: 2.5: must be at most sensor_max_mps, 2",
        ),
        (
            Mobile { sensor_max_mps: 5.0, ..m() },
            "sensor_max_mps: 5: must be less than speed_mps, 5",
        ),
        (
            Mobile { timespan_s: 1e9, ..m() },
            "timespan_s: 1000000000: must leave the trajectories fewer than some ten million rows",
        ),
        (Mobile { alpha: 0.0, ..m() }, "alpha: 0: must be > 0"),
        (Mobile { alpha: 1.5, ..m() }, "alpha: 1.5: must be in [0, 1]"),
        (Mobile { epsilon: -0.1, ..m() }, "epsilon: -0.1: must be in [0, 1]"),
        (Mobile { request_below: 2.0, ..m() }, "request_below: 2: must be in [0, 1]"),
        (Mobile { battery_j: -1.0, ..m() }, "battery_j: -1: must be > 0"),
        (Mobile { transfer_w: f64::INFINITY, ..m() }, "transfer_w: inf: must be > 0"),
    ];
    for (options, line) in bad_m {
        assert_eq!(mobile(&options, 0).unwrap_err().to_string(), line);
    }
}
