//! Gaps of the baseline on generated scenarios: a short run against the best of long runs.
//!
//! `cells SHORT_S LONG_S SEEDS COUNT [CELL...]`, a cell being `n/k/alpha` (k-coverage), `reward/n/capacity`
//! or `mobile/n/timespan`. Each line: scenarios with a known feasible tour, how many of those the short
//! run found, mean and largest gap over them, median time of the short run.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

mod support;

use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, SolverName, solve};

use support::{draw, spent};

const CELLS: [&str; 14] = [
    "48/3/0.45",
    "64/3/0.45",
    "72/3/0.45",
    "80/3/0.45",
    "64/2/0.45",
    "64/4/0.45",
    "32/2/0.2",
    "32/2/0.4",
    "32/2/0.6",
    "32/2/0.8",
    "48/3/0.2",
    "48/3/0.4",
    "48/3/0.6",
    "48/3/0.8",
];

fn run(scenario: &Scenario, seconds: f64, seed: u64) -> (Plan, f64) {
    let begin = Instant::now();
    let zero = spent(begin);

    let stop = |i: u64| i.is_multiple_of(16) && spent(begin) - zero >= seconds;
    let options = Options { solver: SolverName::Auto, seed, stop: &stop, policy: None };
    let plan = solve(scenario, &options).unwrap().plan;
    let elapsed = spent(begin) - zero;

    let broken = check(scenario, &plan);
    assert!(broken.is_empty(), "{broken:?}");
    (plan, elapsed)
}

fn main() {
    let mut args = std::env::args().skip(1);
    let mut number = || args.next().unwrap().parse::<f64>().unwrap();
    let (short_s, long_s, seeds, count) = (number(), number(), number() as u64, number() as u64);
    let mut cells: Vec<String> = args.collect();
    if cells.is_empty() {
        cells = CELLS.map(str::to_owned).to_vec();
    }
    for cell in cells {
        let (mut known, mut found, mut gaps, mut times) = (0, 0, Vec::new(), Vec::new());
        let mut stops = 0;
        for seed in 0..count {
            let scenario = Scenario::from_document(&draw(&cell, seed)).unwrap();
            let (plan, elapsed) = run(&scenario, short_s, 0);
            times.push(elapsed);
            stops += plan.stops.len();
            let mut feasible: Vec<f64> = Vec::new();
            let longs = (1..=seeds).map(|seed| run(&scenario, long_s, seed).0);
            for plan in longs.chain([plan.clone()]) {
                if plan.status.is_feasible() {
                    feasible.push(plan.objective);
                }
            }
            if feasible.is_empty() {
                continue;
            }
            known += 1;
            if plan.status.is_feasible() {
                found += 1;
                let minimise = scenario.objective.name() == "min_distance";
                let best =
                    feasible.iter().copied().reduce(if minimise { f64::min } else { f64::max });
                let best = best.unwrap();
                gaps.push((plan.objective - best).abs() / best.abs().max(1e-9));
            }
        }
        times.sort_by(f64::total_cmp);
        let mean = gaps.iter().sum::<f64>() / gaps.len().max(1) as f64;
        let most = gaps.iter().copied().fold(0.0, f64::max);
        println!(
            "{cell:16} found {found}/{known} of {count}, gap mean {:.3} % most {:.2} %, stops {:.1}, median {:.1} ms, most {:.0} ms",
            100.0 * mean,
            100.0 * most,
            stops as f64 / count as f64,
            1e3 * times[times.len() / 2],
            1e3 * times[times.len() - 1],
        );
    }
}
