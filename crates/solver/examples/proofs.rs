//! Proof times of the exact solver: `proofs LIMIT_S COUNT CELL...`, a cell being as in `cells`, or a file.
//! Each line: scenarios proven, median and largest time of one thread, compiling included.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

mod support;

use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::plan::Status;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, SolverName, solve};

use support::{draw, spent};

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
            let zero_s = spent(begin);
            let stop = |i: u64| i.is_multiple_of(16) && spent(begin) - zero_s >= limit_s;
            let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
            let plan = solve(&scenario, &options).unwrap().plan;
            let elapsed_s = spent(begin) - zero_s;
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
