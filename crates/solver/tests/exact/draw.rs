//! Tiny scenarios that are as awkward as the format allows: ties, zeros, matrices that are no distances,
//! sensors that move, charges that saturate, and requests that nobody can or need serve.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use voltour_solver::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, Objective, RequestDocument,
    SensorDocument, TravelDocument,
};

/// Where sensors are and how far it is to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ground {
    Plane,
    Lattice,
    OnePlace,
    RealMatrix,
    WholeMatrix,
    SymmetricMatrix,
    ZeroMatrix,
    Moving,
}

use Ground::{
    Lattice, Moving, OnePlace, Plane, RealMatrix, SymmetricMatrix, WholeMatrix, ZeroMatrix,
};

const GROUNDS: [Ground; 12] = [
    Plane,
    Plane,
    Lattice,
    Lattice,
    OnePlace,
    RealMatrix,
    WholeMatrix,
    WholeMatrix,
    SymmetricMatrix,
    ZeroMatrix,
    Moving,
    Moving,
];

/// The source of all choices.
pub fn rng(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed ^ 0x5EED)
}

/// One of some.
pub fn one<T: Copy>(rng: &mut Pcg64Mcg, of: &[T]) -> T {
    of[rng.random_range(0..of.len())]
}

/// A scenario of `n` requests on any ground.
pub fn awkward(n: usize, seed: u64) -> Document {
    let ground = one(&mut rng(!seed), &GROUNDS);
    on(ground, n, seed)
}

/// A scenario of `n` requests on this ground.
pub fn on(ground: Ground, n: usize, seed: u64) -> Document {
    let rng = &mut rng(seed);
    let k = (ground != Moving && rng.random_bool(0.4)).then(|| rng.random_range(1..=3_u8));
    let spare = rng.random_range(0..3);
    let sensors: Vec<_> = (0..n + spare).map(|i| sensor(rng, ground, i, k.is_some())).collect();
    let end = [None, Some([50.0, 50.0]), Some([80.0, 20.0])];
    let span = one(rng, &[None, None, None, Some(0.0), Some(1.0), Some(1.0)]);
    let capacity = one(rng, &[None, None, None, Some(0.0), Some(1.0), Some(1.0)]);
    Document {
        format: FORMAT.to_owned(),
        name: Some(format!("awkward-{ground:?}-{n}-{seed}")),
        objective: one(rng, &[Objective::MinDistance, Objective::MaxReward, Objective::MaxCount]),
        charger: ChargerDocument {
            start_m: [50.0, 50.0],
            end_m: one(rng, &end),
            speed_mps: if ground == Moving { 5.0 } else { one(rng, &[1.0, 5.0, 5.0]) },
            travel_jpm: one(rng, &[0.0, 1.0, 1.0, 7.5]),
            transfer_w: one(rng, &[2.0, 10.0, 10.0, 1e6]),
            capacity_j: capacity.map(|share| share * rng.random_range(20.0..800.0)),
            timespan_s: span.map(|share: f64| share * rng.random_range(5.0..150.0)),
        },
        charge_level: one(rng, &[None, None, Some(0.6), Some(0.3)]),
        coverage: k.map(|k| CoverageDocument {
            k: f64::from(k),
            field_m: vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]],
        }),
        requests: requests(rng, n),
        travel: matrix(rng, ground, n + 2),
        sensors,
    }
}

fn sensor(rng: &mut Pcg64Mcg, ground: Ground, i: usize, covers: bool) -> SensorDocument {
    let mut place = || match ground {
        OnePlace => [60.0, 40.0],
        Lattice => [25.0 * f64::from(rng.random_range(0..5_u8)), 50.0],
        _ => [rng.random_range(0.0..100.0), rng.random_range(0.0..100.0)],
    };
    let rests = ground != Moving || i % 3 == 2;
    let position_m = rests.then(&mut place);
    let trajectory = (!rests).then(|| {
        let row = |j: usize| {
            let [x, y] = place();
            [40.0 * j as f64 - 10.0, x, y]
        };
        (0..1 + (i * 7) % 5).map(row).collect()
    });
    let range_m = covers.then(|| one(rng, &[45.0, 60.0, 80.0, 150.0]));
    SensorDocument { id: format!("s{i}"), position_m, trajectory, range_m, battery_j: 100.0 }
}

fn requests(rng: &mut Pcg64Mcg, n: usize) -> Vec<RequestDocument> {
    let late: f64 = one(rng, &[60.0, 150.0, 400.0]);
    let common: f64 = rng.random_range(0.0..late);
    let deadlines = rng.random_range(0..5_u8);
    let waits = one(rng, &[0.0, 0.0, 0.3, 0.8]);
    let drain = one(rng, &[0.0, 0.0, 0.5, 3.0]);
    let required = one(rng, &[0.0, 0.0, 0.2, 0.6]);
    let rewards = rng.random_range(0..5_u8);
    let request = |i: usize| {
        let ready = if rng.random_bool(waits) { rng.random_range(0.0..60.0) } else { 0.0 };
        let deadline_s = match deadlines {
            0 => None,
            1 => Some(ready + rng.random_range(0.0..25.0)),
            2 => Some(common.max(ready)),
            _ => rng.random_bool(0.8).then(|| ready + rng.random_range(0.0..late)),
        };
        let whole = f64::from(rng.random_range(0..4_u8));
        RequestDocument {
            sensor: format!("s{i}"),
            ready_s: Some(ready),
            deadline_s,
            residual_j: match rng.random_range(0..8_u8) {
                0 | 1 => None,
                // Charged already at one of the levels, or by a hair not.
                2 => Some(one(rng, &[30.0, 60.0, 100.0, 99.999_999])),
                3 => Some(0.0),
                _ => Some(rng.random_range(0.0..100.0)),
            },
            drain_w: (drain > 0.0 && rng.random_bool(0.8)).then(|| rng.random_range(0.0..drain)),
            reward: match rewards {
                0 => None,
                1 => Some(0.0),
                2 => Some(whole),
                3 => Some(1000.0 * whole),
                _ => rng.random_bool(0.7).then(|| rng.random_range(0.0..5.0)),
            },
            required: Some(rng.random_bool(required)),
        }
    };
    (0..n).map(request).collect()
}

fn matrix(rng: &mut Pcg64Mcg, ground: Ground, size: usize) -> Option<TravelDocument> {
    let mut entry = |_: usize| match ground {
        RealMatrix => rng.random_range(0.0..100.0),
        ZeroMatrix => 0.0,
        _ if rng.random_bool(0.2) => 0.0,
        _ => f64::from(rng.random_range(1..20_u8)) * 5.0,
    };
    let mut distance_m: Vec<Vec<f64>> =
        (0..size).map(|_| (0..size).map(&mut entry).collect()).collect();
    if ground == SymmetricMatrix {
        let upper = distance_m.clone();
        for (a, row) in distance_m.iter_mut().enumerate() {
            row.iter_mut().take(a).enumerate().for_each(|(b, leg_m)| *leg_m = upper[b][a]);
        }
    }
    let given = [RealMatrix, WholeMatrix, SymmetricMatrix, ZeroMatrix].contains(&ground);
    given.then_some(TravelDocument { distance_m })
}
