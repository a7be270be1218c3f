//! Renaming, reordering, moving and turning change neither status nor objective.

use std::f64::consts::TAU;

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Document, Scenario, TravelDocument};
use voltour_solver::tolerance::tolerance;

use crate::draw::{awkward, rng};
use crate::run::{AMPLE, exact, trials};

fn solved(document: &Document) -> Plan {
    exact(&Scenario::from_document(document).unwrap(), 0, AMPLE)
}

/// The numbers 0 to `n` - 1 in random order.
fn shuffled(n: usize, rng: &mut Pcg64Mcg) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, rng.random_range(0..=i));
    }
    order
}

/// The same scenario with requests, sensors and rows of the matrix in another order.
fn reordered(document: &Document, rng: &mut Pcg64Mcg) -> Document {
    let requests = shuffled(document.requests.len(), rng);
    let sensors = shuffled(document.sensors.len(), rng);
    let places: Vec<usize> = [0, 1].into_iter().chain(requests.iter().map(|r| r + 2)).collect();
    let travel = document.travel.as_ref().map(|travel| {
        let row = |&a: &usize| places.iter().map(|&b| travel.distance_m[a][b]).collect();
        TravelDocument { distance_m: places.iter().map(row).collect() }
    });
    Document {
        requests: requests.iter().map(|&r| document.requests[r].clone()).collect(),
        sensors: sensors.iter().map(|&s| document.sensors[s].clone()).collect(),
        travel,
        ..document.clone()
    }
}

/// The same scenario on a plane that was turned, then moved.
fn moved(document: &Document, rng: &mut Pcg64Mcg) -> Document {
    let (sin, cos) = rng.random_range(0.0..TAU).sin_cos();
    let by = [rng.random_range(-500.0..500.0), rng.random_range(-500.0..500.0)];
    let to = |[x, y]: [f64; 2]| [cos * x - sin * y + by[0], sin * x + cos * y + by[1]];
    let mut document = document.clone();
    document.charger.start_m = to(document.charger.start_m);
    document.charger.end_m = document.charger.end_m.map(to);
    if let Some(coverage) = &mut document.coverage {
        coverage.field_m.iter_mut().for_each(|corner| *corner = to(*corner));
    }
    for sensor in &mut document.sensors {
        sensor.position_m = sensor.position_m.map(to);
        for row in sensor.trajectory.iter_mut().flatten() {
            let [x, y] = to([row[1], row[2]]);
            *row = [row[0], x, y];
        }
    }
    document
}

fn assert_same(document: &Document, first: &Plan, second: &Plan) {
    assert_eq!(first.status, second.status, "{:?}", document.name);
    let differ = (first.objective - second.objective).abs();
    let same = differ <= 1.001 * tolerance(first.objective);
    assert!(same || !first.status.is_feasible(), "{:?}: {first:?} {second:?}", document.name);
}

#[test]
fn the_order_of_the_document_does_not_matter() {
    for seed in 0..trials(500) {
        let document = awkward(2 + (seed % 6) as usize, 4_000_000 + seed);
        let other = reordered(&document, &mut rng(seed));
        assert_same(&document, &solved(&document), &solved(&other));
    }
}

#[test]
fn moving_and_turning_the_plane_changes_nothing() {
    for seed in 0..trials(500) {
        let document = awkward(2 + (seed % 6) as usize, 5_000_000 + seed);
        if document.travel.is_none() {
            let other = moved(&document, &mut rng(seed));
            assert_same(&document, &solved(&document), &solved(&other));
        }
    }
}
