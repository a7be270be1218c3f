//! Our solver, timed.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, solve};

use super::Arguments;

/// What our solver found, and in which time.
pub struct Ours {
    /// Its plan.
    pub plan: Plan,
    /// Wall time of the whole solve, from the parsed scenario to the plan.
    pub solve_s: f64,
    /// Wall time of the compilation alone, which is the first part of a solve.
    pub compile_s: f64,
}

impl Ours {
    // The benchmark measures, so it needs the clock that the library must not read.
    #[allow(clippy::disallowed_methods)]
    pub fn solve(scenario: &Scenario, arguments: &Arguments) -> Result<Self, Box<dyn Error>> {
        let begin = Instant::now();
        black_box(Instance::new(black_box(scenario)));
        let compile_s = begin.elapsed().as_secs_f64();

        let begin = Instant::now();
        let stop = |_: u64| begin.elapsed().as_secs_f64() >= arguments.solver_limit_s;
        let options = Options { solver: arguments.solver, seed: 0, stop: &stop };
        let plan = solve(scenario, &options)?.plan;
        let solve_s = begin.elapsed().as_secs_f64();

        let broken = check(scenario, &plan);
        if !broken.is_empty() {
            return Err(format!("the check refuses our plan: {broken:?}").into());
        }
        Ok(Self { plan, solve_s, compile_s })
    }

    /// Whether it proved its answer.
    pub fn is_proven(&self) -> bool {
        matches!(self.plan.status, Status::Optimal | Status::Infeasible)
    }
}
