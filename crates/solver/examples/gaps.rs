//! Solves scenario files and prints the objective of each, with the gap to a table of best known
//! values: `gaps SECONDS SEEDS SOLVER [--best TABLE.csv] FILE...`.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

mod support;

use std::time::Instant;

use voltour_solver::check;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, solve};

use support::spent;

fn main() {
    let mut args = std::env::args().skip(1);
    let seconds: f64 = args.next().unwrap().parse().unwrap();
    let seeds: u64 = args.next().unwrap().parse().unwrap();
    let solver = args.next().unwrap().parse().unwrap();
    let mut files: Vec<String> = args.collect();
    let mut table = String::new();
    if files.first().is_some_and(|f| f == "--best") {
        table = std::fs::read_to_string(&files[1]).unwrap();
        files.drain(..2);
    }
    let (mut sum, mut count) = (0.0, 0.0);
    for file in &files {
        let scenario = Scenario::from_json(&std::fs::read(file).unwrap()).unwrap();
        let name = file.rsplit('/').next().unwrap();
        let known = table.lines().find_map(|l| l.strip_prefix(name)?.split(',').nth(2));
        let known: Option<f64> = known.and_then(|k| k.parse().ok());
        let mut line = format!("{name:45}");
        for seed in 0..seeds {
            let begin = Instant::now();
            let zero = spent(begin);

            let stop = |i: u64| i.is_multiple_of(16) && spent(begin) - zero >= seconds;
            let outcome =
                solve(&scenario, &Options { solver, seed, stop: &stop, policy: None }).unwrap();
            let elapsed = spent(begin) - zero;

            let faults = check::check(&scenario, &outcome.plan);
            let plan = &outcome.plan;
            line += &format!(
                " {}{:.4}",
                if plan.status.is_feasible() { "" } else { "!" },
                plan.objective
            );
            if let Some(known) = known {
                let gap = 100.0 * (plan.objective - known).abs() / known.abs().max(1e-9);
                line += &format!(" ({gap:.2} %)");
                sum += gap;
                count += 1.0;
            }
            let iterations: u64 = outcome.iterations.iter().map(|(_, n)| n).sum();
            line += &format!(" {:.0} ms {iterations} it;", 1e3 * elapsed);
            if !faults.is_empty() {
                line += &format!(" BROKEN {faults:?}");
            }
        }
        println!("{line}");
    }
    if count > 0.0 {
        println!("mean gap {:.3} %", sum / count);
    }
}
