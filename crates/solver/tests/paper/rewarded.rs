//! The algorithms for the largest reward within a capacity.

use voltour_solver::generate::{Reward, reward};
use voltour_solver::scenario::{Document, Scenario};
use voltour_solver::solvers::{PaperOptions, SolverName, Unfinished};

use crate::run::{AMPLE, attempt, ids, optimum, parsed, plan, trials};

fn draw(sensors: u32, capacity_j: f64, seed: u64) -> Document {
    reward(&Reward { sensors, capacity_j, alpha: 1.0, ..Reward::default() }, seed).unwrap()
}

fn objective(scenario: &Scenario, solver: SolverName) -> f64 {
    plan(scenario, solver, &PaperOptions::default()).objective
}

#[test]
fn app_is_never_below_a_quarter_of_the_optimum() {
    let (mut seen, mut worst, mut seed) = (0, 1.0_f64, 0);
    while seen < trials(60) {
        seed += 1;
        let sensors = 12 + (seed % 9) as u32;
        let scenario = parsed(&draw(sensors, 900_000.0 + 60_000.0 * (seed % 13) as f64, seed));
        let Some(best) = optimum(&scenario).filter(|best| best.stops.len() >= 8) else { continue };
        seen += 1;
        let app = objective(&scenario, SolverName::App);
        let name = &scenario.name;
        assert!(app <= best.objective * (1.0 + 1e-6), "{name:?}: {app} {}", best.objective);
        assert!(app >= 0.25 * best.objective, "{name:?}: {app} {}", best.objective);
        worst = worst.min(app / best.objective);
    }
    assert!(worst < 1.0, "too easy");
    println!("the worst of {seen}: {worst:.3} of the optimum");
}

#[test]
fn app_keeps_its_quarter_where_rewards_differ_by_far() {
    for seed in 0..trials(40) {
        let mut document = draw(11, 700_000.0, seed);
        for (i, request) in document.requests.iter_mut().enumerate() {
            request.reward = Some([0.0, 1.0, 3.0, 1_000.0][(i + seed as usize) % 4]);
        }
        let scenario = parsed(&document);
        let best = optimum(&scenario).unwrap().objective;
        let app = objective(&scenario, SolverName::App);
        assert!(app >= 0.25 * best && app <= best + 1e-6, "{:?}: {app} {best}", scenario.name);
    }
}

#[test]
fn trees_are_legal_and_beat_no_optimum() {
    let (mut mst, mut cmst) = (0.0, 0.0);
    for seed in 0..trials(40) {
        let scenario = parsed(&draw(14, 1_000_000.0, seed));
        let best = optimum(&scenario).unwrap().objective;
        let each = [SolverName::Mst, SolverName::Cmst].map(|solver| objective(&scenario, solver));
        assert!(each.iter().all(|&tree| tree > 0.0 && tree <= best + 1e-3), "{each:?} {best}");
        mst += each[0];
        cmst += each[1];
    }
    // Neither is a copy of the other.
    assert!(mst != cmst);
}

/// Sensors at these places around the station with these rewards; a battery of 1 J each, 1 J per metre.
fn field(places: &[[f64; 2]], rewards: &[f64], capacity_j: f64) -> Scenario {
    let mut document = draw(places.len() as u32, capacity_j, 1);
    document.charger.start_m = [0.0, 0.0];
    document.charger.end_m = Some([0.0, 0.0]);
    document.charger.travel_jpm = 1.0;
    for (sensor, place) in document.sensors.iter_mut().zip(places) {
        (sensor.position_m, sensor.battery_j) = (Some(*place), 1.0);
    }
    for (request, reward) in document.requests.iter_mut().zip(rewards) {
        (request.residual_j, request.reward) = (Some(0.0), Some(*reward));
    }
    parsed(&document)
}

/// Five sensors on a cross: 10 m, 20 m and 30 m to the east, 12 m to the north, 40 m to the west.
fn cross(capacity_j: f64) -> Scenario {
    let places = [[10.0, 0.0], [20.0, 0.0], [30.0, 0.0], [0.0, 12.0], [-40.0, 0.0]];
    field(&places, &[1.0; 5], capacity_j)
}

#[test]
fn the_tree_of_a_cross_is_the_cross() {
    let tree = |capacity_j, solver| {
        let plan = plan(&cross(capacity_j), solver, &PaperOptions::default());
        (ids(&plan).join(" "), plan.objective)
    };
    // Prim joins s1, s2, s3, each 10 m from the tree, then s4; for s5, 40 m off, the capacity is short.
    assert_eq!(tree(120.0, SolverName::Mst), ("s1 s2 s3 s4".to_owned(), 4.0));
    // The tour with s4 is 74.3 m long: with 70 J only the branch to the east is left.
    assert_eq!(tree(70.0, SolverName::Mst), ("s1 s2 s3".to_owned(), 3.0));
    // Esau and Williams join the east to one branch, which saves 10 m and 20 m; s4 hangs on the station.
    assert_eq!(tree(70.0, SolverName::Cmst), ("s1 s2 s3".to_owned(), 3.0));
    // There and back to s2 are 40 m and 2 J: s3 no longer fits.
    assert_eq!(tree(50.0, SolverName::Cmst).1, 2.0);
    assert_eq!(tree(1_000.0, SolverName::App).1, 5.0);
}

#[test]
fn branches_beyond_the_capacity_are_not_joined() {
    // Both would take 81.8 J: joined, the far one, which is worth most, would be left for the near one.
    let line = field(&[[20.0, 0.0], [39.9, 0.0]], &[1.0, 10.0], 81.5);
    assert_eq!(ids(&plan(&line, SolverName::Cmst, &PaperOptions::default())), ["s2"]);
    assert_eq!(ids(&plan(&line, SolverName::Mst, &PaperOptions::default())), ["s1"]);
}

#[test]
fn limits_end_app_without_a_tour() {
    let scenario = parsed(&draw(14, 1_000_000.0, 5));
    let limits = [(2_000, AMPLE, Unfinished::Memory), (1 << 30, 20, Unfinished::Budget)];
    for (memory_bytes, iterations, expected) in limits {
        let options = PaperOptions { memory_bytes, ..PaperOptions::default() };
        let outcome = attempt(&scenario, SolverName::App, &options, iterations).unwrap();
        assert_eq!(outcome.unfinished, Some(expected));
        assert!(outcome.plan.stops.is_empty());
    }
}

/// Sensors in clusters far from the station, each worth little, with others near it that are worth more for
/// their detour: what looks best first is not what a tour should go for.
fn clusters(seed: u64) -> Scenario {
    let mut document = draw(15, 100.0 + 15.0 * (seed % 11) as f64, seed);
    let charger = &mut document.charger;
    (charger.start_m, charger.end_m, charger.travel_jpm) = ([0.0, 0.0], Some([0.0, 0.0]), 1.0);
    let count = 2 + seed as usize % 3;
    for (i, (sensor, request)) in
        document.sensors.iter_mut().zip(&mut document.requests).enumerate()
    {
        let cluster = i % (count + 1);
        let turn = std::f64::consts::TAU * cluster as f64 / count as f64 + seed as f64;
        let far_m = if cluster == count { 6.0 + i as f64 } else { 40.0 };
        let spread = sensor.position_m.unwrap().map(|side| (side - 500.0) / 250.0);
        sensor.position_m = Some([far_m * turn.cos() + spread[0], far_m * turn.sin() + spread[1]]);
        sensor.battery_j = 1.0;
        request.residual_j = Some(0.0);
        request.reward = Some(if cluster == count { 2.0 } else { 1.0 + seed as f64 % 2.0 });
    }
    parsed(&document)
}

#[test]
fn app_keeps_its_quarter_where_the_nearest_is_not_the_best() {
    let mut least = 1.0_f64;
    for seed in 0..trials(60) {
        let scenario = clusters(seed);
        let best = optimum(&scenario).unwrap().objective;
        let app = objective(&scenario, SolverName::App);
        assert!(app >= 0.25 * best && app <= best + 1e-6, "{:?}: {app} {best}", scenario.name);
        least = least.min(app / best);
    }
    println!("the least share of the optimum: {least:.3}");
}
