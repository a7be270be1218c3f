//! How these tests run the exact solver, and how often.

use std::cell::Cell;

use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, SolverName, solve};
use voltour_solver::stop::MaxIterations;

/// More than small scenarios need.
pub const AMPLE: u64 = 1_000_000;

/// The plan of the exact solver.
pub fn exact(scenario: &Scenario, seed: u64, iterations: u64) -> Plan {
    let options =
        Options { solver: SolverName::Exact, seed, stop: &MaxIterations(iterations), policy: None };
    solve(scenario, &options).unwrap().plan
}

/// The plan of the exact solver, told to stop when it has asked so often, in the middle of a step, too; and how often it
/// asked.
pub fn broken_off(scenario: &Scenario, asked: u64) -> (Plan, u64) {
    let times = Cell::new(0);
    let stop = |_: u64| {
        times.set(times.get() + 1);
        times.get() > asked
    };
    let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
    let plan = solve(scenario, &options).unwrap().plan;
    (plan, times.get())
}

/// The trials of a test that has so many by default, scaled as `VOLTOUR_TRIALS` asks.
pub fn trials(default: u64) -> u64 {
    const LARGEST: u64 = 1_500;
    let asked = std::env::var("VOLTOUR_TRIALS").map_or(LARGEST, |text| text.parse().unwrap());
    (default * asked).div_ceil(LARGEST)
}
