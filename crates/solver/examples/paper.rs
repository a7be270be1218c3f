//! The paper's algorithms beside the proven optimum: `paper LIMIT_S COUNT SOLVERS CELL...`, solvers separated by
//! commas, a cell being as in `cells`; `STEP_S`, `APP_STEP_S`, `LITERAL`, `SLACK`, `BETA` and `Q0` in the environment set options. Each line:
//! scenarios finished, feasible ones, mean objective and mean gap to the optimum over those, median and largest time.
#![allow(clippy::disallowed_methods, clippy::print_stdout, clippy::unwrap_used)]

mod support;

use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, Outcome, PaperOptions, SolverName, solve_with};

use support::{draw, spent};

fn main() {
    let mut args = std::env::args().skip(1);
    let limit_s: f64 = args.next().unwrap().parse().unwrap();
    let count: u64 = args.next().unwrap().parse().unwrap();
    let solvers: Vec<SolverName> =
        args.next().unwrap().split(',').map(|name| name.parse().unwrap()).collect();
    let paper = options();
    for cell in args {
        let scenarios: Vec<Scenario> =
            (0..count).map(|seed| Scenario::from_document(&draw(&cell, seed)).unwrap()).collect();
        let optima: Vec<Outcome> =
            scenarios.iter().map(|s| run(s, SolverName::Exact, 60.0, &paper).0).collect();
        for &solver in &solvers {
            let runs: Vec<(Outcome, f64)> =
                scenarios.iter().map(|s| run(s, solver, limit_s, &paper)).collect();
            println!("{cell:16} {:8} {}", solver.name(), row(&optima, &runs));
        }
    }
}

fn options() -> PaperOptions {
    let number = |name| std::env::var(name).ok().map(|text| text.parse::<f64>().unwrap());
    let mut paper =
        PaperOptions { literal: std::env::var_os("LITERAL").is_some(), ..Default::default() };
    paper.dp_step_s = number("STEP_S").unwrap_or(paper.dp_step_s);
    paper.app_step_s = number("APP_STEP_S").unwrap_or(paper.app_step_s);
    paper.acs.slack = number("SLACK").unwrap_or(paper.acs.slack);
    paper.acs.beta = number("BETA").unwrap_or(paper.acs.beta);
    paper.acs.q0 = number("Q0").unwrap_or(paper.acs.q0);
    paper
}

fn run(
    scenario: &Scenario,
    solver: SolverName,
    limit_s: f64,
    paper: &PaperOptions,
) -> (Outcome, f64) {
    let begin = Instant::now();
    let zero_s = spent(begin);
    let stop = |i: u64| i.is_multiple_of(16) && spent(begin) - zero_s >= limit_s;
    let options = Options { solver, seed: 0, stop: &stop, policy: None };
    let outcome = solve_with(&Instance::new(scenario), &options, paper).unwrap();
    let elapsed_s = spent(begin) - zero_s;
    let broken = check(scenario, &outcome.plan);
    assert!(broken.is_empty(), "{broken:?}");
    (outcome, elapsed_s)
}

fn row(optima: &[Outcome], runs: &[(Outcome, f64)]) -> String {
    let (mut finished, mut objectives, mut gaps, mut times) =
        (0, Vec::new(), Vec::new(), Vec::new());
    let mut stops = 0;
    for (best, (found, elapsed_s)) in optima.iter().zip(runs) {
        times.push(*elapsed_s);
        if found.unfinished.is_some() {
            continue;
        }
        finished += 1;
        if found.plan.status.is_feasible() {
            let (objective, best) = (found.plan.objective, best.plan.objective);
            objectives.push(objective);
            gaps.push(if objective == best { 0.0 } else { (objective - best).abs() / best.abs() });
            stops += found.plan.stops.len();
        }
    }
    times.sort_by(f64::total_cmp);
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len().max(1) as f64;
    format!(
        "finished {finished} of {}, feasible {}, mean {:.1}, stops {:.1}, gap {:.2} %, most {:.1} %, median {:.2} ms, most {:.0} ms",
        runs.len(),
        gaps.len(),
        mean(&objectives),
        stops as f64 / gaps.len().max(1) as f64,
        100.0 * mean(&gaps),
        100.0 * gaps.iter().copied().fold(0.0, f64::max),
        1e3 * times[times.len() / 2],
        1e3 * times[times.len() - 1],
    )
}
