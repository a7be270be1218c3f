//! Time of the regions and demands of uniform deployments at the density of the paper's largest
//! setting, and the ratio of the times per region, of which there are as many as
//! vertices. A sensor of the smallest field has half the neighbours of one of the largest, most of
//! which is not near a border: a ratio near 2 means near-linear.

// Printing is what it is for.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use voltour_solver::coverage::{demands, regions};
use voltour_solver::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, Objective, RequestDocument, Scenario,
    SensorDocument,
};

/// Sensors on the smallest field, 500 m by 500 m.
const FEW: usize = 80;

fn main() {
    for requesting in [0.45, 0.8] {
        println!("{:.0} % of the sensors requesting, range 135 m, k = 3", 100.0 * requesting);
        let small = measure(FEW, requesting, 200);
        let medium = measure(1_000, requesting, 10);
        let large = measure(10_000, requesting, 3);
        println!("time per region,  1,000 sensors / 80: {:.2}", medium / small);
        println!("time per region, 10,000 sensors / 80: {:.2}\n", large / small);
    }
}

/// Prints the best time of some runs; returns it per region, in seconds.
fn measure(sensors: usize, requesting: f64, runs: usize) -> f64 {
    let scenario = uniform(sensors, requesting);
    let mut best = [Duration::MAX; 2];
    let mut sizes = [0; 2];
    for _ in 0..runs {
        let (found, first) = timed(|| regions(black_box(&scenario)));
        let (kept, second) = timed(|| demands(black_box(&scenario), &found));
        best = [best[0].min(first), best[1].min(second)];
        sizes = [found.len(), kept.len()];
    }
    let [first, second] = best.map(|time| 1e3 * time.as_secs_f64());
    println!(
        "{sensors:>6} sensors: {:>7} regions in {first:>9.3} ms, {:>6} demands in {second:>9.3} ms",
        sizes[0], sizes[1]
    );
    best.iter().sum::<Duration>().as_secs_f64() / sizes[0] as f64
}

// The benchmark measures, so it needs the clock that the library must not read.
#[allow(clippy::disallowed_methods)]
fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

fn uniform(sensors: usize, requesting: f64) -> Scenario {
    let side = 500.0 * (sensors as f64 / FEW as f64).sqrt();
    let mut random = Pcg64::seed_from_u64(1);
    let mut sensor = |i| SensorDocument {
        id: format!("s{i}"),
        position_m: Some([random.random_range(0.0..side), random.random_range(0.0..side)]),
        trajectory: None,
        range_m: Some(135.0),
        battery_j: 10_800.0,
    };
    let sensors: Vec<_> = (0..sensors).map(&mut sensor).collect();
    let request = |sensor: &SensorDocument| RequestDocument {
        sensor: sensor.id.clone(),
        ready_s: None,
        deadline_s: None,
        residual_j: None,
        drain_w: None,
        reward: None,
        required: None,
    };
    let asking = (sensors.len() as f64 * requesting) as usize;
    let document = Document {
        format: FORMAT.into(),
        name: None,
        objective: Objective::MinDistance,
        charger: ChargerDocument {
            start_m: [0.0, 0.0],
            end_m: None,
            speed_mps: 5.0,
            travel_jpm: 600.0,
            transfer_w: 20.0,
            capacity_j: None,
            timespan_s: None,
        },
        charge_level: None,
        coverage: Some(CoverageDocument {
            k: 3.0,
            field_m: vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]],
        }),
        requests: sensors.iter().take(asking).map(request).collect(),
        sensors,
        travel: None,
    };
    Scenario::from_document(&document).expect("a valid scenario")
}
