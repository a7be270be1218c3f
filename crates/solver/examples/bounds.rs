//! How near the quick bounds come on large scenarios: `bounds [SECONDS] [SEEDS] [WORD]` prints the gap of the baseline's
//! tour after so many seconds to the quick bound, and the seconds that the bound took.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

mod support;

use std::time::Instant;

use voltour_solver::generate::{Mobile, Reward, mobile, reward};
use voltour_solver::instance;
use voltour_solver::scenario::{CoverageDocument, Document, Objective, Scenario};
use voltour_solver::solvers::{Options, SolverName, exact::quick_bound, solve_compiled};

use support::spent;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let seconds: f64 = args.first().map_or(2.0, |s| s.parse().unwrap());
    let seeds: u64 = args.get(1).map_or(2, |s| s.parse().unwrap());
    let word = args.get(2).cloned().unwrap_or_default();
    println!(
        "{:22} {:>5} {:>5} {:>10} {:>10} {:>8} {:>7}",
        "scenario", "n", "stops", "tour", "bound", "gap", "time"
    );
    for (name, draw) in kinds() {
        for seed in (0..seeds).filter(|_| name.contains(&word)) {
            line(&name, &Scenario::from_document(&draw(seed)).unwrap(), seconds);
        }
    }
}

fn line(name: &str, scenario: &Scenario, seconds: f64) {
    let instance = instance::Instance::new(scenario);
    let begin = Instant::now();
    let zero = spent(begin);
    let stop = |_: u64| spent(begin) - zero >= seconds;
    let options = Options { solver: SolverName::Baseline, seed: 0, stop: &stop, policy: None };
    let plan = solve_compiled(&instance, &options).unwrap().plan;
    let known = plan.status.is_feasible().then_some(plan.objective);
    let zero = spent(begin);
    let bound = quick_bound(&instance, known).unwrap_or(f64::NAN);
    let took = spent(begin) - zero;
    let (n, stops) = (instance.len(), plan.stops.len());
    let gap = 100.0 * (plan.objective - bound).abs() / bound.abs();
    println!(
        "{name:22} {n:>5} {stops:>5} {:>10.0} {bound:>10.0} {gap:>6.2} % {took:>5.2} s{}",
        plan.objective,
        if known.is_some() { "" } else { " (no feasible tour)" }
    );
}

type Draw = Box<dyn Fn(u64) -> Document>;

fn kinds() -> Vec<(String, Draw)> {
    let mut kinds: Vec<(String, Draw)> = Vec::new();
    for n in [1_000, 3_000] {
        kinds.push((format!("k_coverage {n}"), Box::new(move |seed| covered(n, seed))));
    }
    for n in [200, 1_000] {
        kinds.push((format!("all required {n}"), Box::new(move |seed| required(n, seed))));
    }
    for n in [300, 1_000, 2_000] {
        for stops in [10.0, 50.0, 200.0] {
            let name = format!("reward {n}, about {stops}");
            kinds.push((name, Box::new(move |seed| prized(n, stops, seed))));
        }
    }
    let moving = |seed| mobile(&Mobile { sensors: 300, ..Mobile::default() }, seed).unwrap();
    kinds.push(("mobile 300".to_owned(), Box::new(moving)));
    kinds
}

/// As dense as in the paper's simulations, without deadlines: one charger could not keep them.
fn covered(sensors: u32, seed: u64) -> Document {
    let side_m = 500.0 * (f64::from(sensors) / 48.0).sqrt();
    let mut document = scattered(sensors, side_m, 0.45, seed);
    for sensor in &mut document.sensors {
        sensor.range_m = Some(135.0);
    }
    let field_m = vec![[0.0, 0.0], [side_m, 0.0], [side_m, side_m], [0.0, side_m]];
    document.coverage = Some(CoverageDocument { k: 3.0, field_m });
    document
}

fn required(sensors: u32, seed: u64) -> Document {
    let mut document = scattered(sensors, 1_000.0, 1.0, seed);
    for request in &mut document.requests {
        request.required = Some(true);
    }
    document
}

fn scattered(sensors: u32, side_m: f64, alpha: f64, seed: u64) -> Document {
    let options = Reward { sensors, side_m, alpha, ..Reward::default() };
    let mut document = reward(&options, seed).unwrap();
    document.objective = Objective::MinDistance;
    document.charger.capacity_j = None;
    document
}

/// With a capacity for about so many stops.
fn prized(sensors: u32, stops: f64, seed: u64) -> Document {
    let leg_m = 600.0 / f64::from(sensors).sqrt();
    let capacity_j = stops * (4_000.0 + 600.0 * leg_m);
    reward(&Reward { sensors, alpha: 1.0, capacity_j, ..Reward::default() }, seed).unwrap()
}
