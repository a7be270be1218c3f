//! Proof times of the exact solver: `proofs LIMIT_S COUNT CELL...`, a cell being as in `cells`, or a file.
//! Each line: scenarios proven, median and largest time of one thread, compiling included.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use voltour_solver::plan::Status;
use voltour_solver::scenario::{Document, Scenario};
use voltour_solver::solvers::{Options, SolverName, solve};

fn draw(cell: &str, seed: u64) -> Document {
    let parts: Vec<&str> = cell.split('/').collect();
    let number = |i: usize| parts[i].parse::<f64>().unwrap();
    match parts[0] {
        "reward" => reward(
            &Reward {
                sensors: number(1) as u32,
                capacity_j: number(2),
                alpha: 1.0,
                ..Reward::default()
            },
            seed,
        ),
        "mobile" => mobile(&Mobile { sensors: number(1) as u32, ..Mobile::default() }, seed),
        _ => k_coverage(
            &KCoverage {
                sensors: number(0) as u32,
                k: number(1) as u32,
                alpha: number(2),
                ..KCoverage::default()
            },
            seed,
        ),
    }
    .unwrap()
}

fn main() {
    let mut args = std::env::args().skip(1);
    let limit_s: f64 = args.next().unwrap().parse().unwrap();
    let count: u64 = args.next().unwrap().parse().unwrap();
    let each = std::env::var_os("EACH").is_some();
    for cell in args {
        let file = std::path::Path::new(&cell).is_file();
        let (mut times, mut proven) = (Vec::new(), 0);
        for seed in 0..if file { 1 } else { count } {
            let scenario = if file {
                Scenario::from_json(&std::fs::read(&cell).unwrap()).unwrap()
            } else {
                Scenario::from_document(&draw(&cell, seed)).unwrap()
            };
            let begin = Instant::now();
            let zero_s = spent_s(begin);
            let stop = |i: u64| i.is_multiple_of(16) && spent_s(begin) - zero_s >= limit_s;
            let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop };
            let plan = solve(&scenario, &options).unwrap().plan;
            let elapsed_s = spent_s(begin) - zero_s;
            let broken = check(&scenario, &plan);
            assert!(broken.is_empty(), "{broken:?}");
            proven += u64::from(matches!(plan.status, Status::Optimal | Status::Infeasible));
            times.push(elapsed_s);
            if each {
                println!(
                    "{cell} {seed}: {} {} bound {:?} in {elapsed_s:.3} s",
                    plan.status.name(),
                    plan.objective,
                    plan.bound
                );
            }
        }
        times.sort_by(f64::total_cmp);
        println!(
            "{cell:16} proven {proven} of {}, median {:.1} ms, most {:.0} ms",
            times.len(),
            1e3 * times[times.len() / 2],
            1e3 * times[times.len() - 1]
        );
    }
}

/// Seconds of processor time of this thread where the system tells it, so that a busy machine measures
/// the same; else seconds since `begin`.
fn spent_s(begin: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = text.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begin.elapsed().as_secs_f64(), |nanoseconds| nanoseconds / 1e9)
}
