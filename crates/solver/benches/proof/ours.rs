//! Our solver, timed.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, solve_compiled};

use super::Arguments;

/// A run that took no longer is repeated: a few milliseconds are at the mercy of whatever else runs.
const SHORT_S: f64 = 0.1;
/// Runs of which the median is taken.
const RUNS: usize = 5;

/// What our solver found, and in which time.
pub struct Ours {
    /// Its plan.
    pub plan: Plan,
    /// Wall time from the compiled instance to the plan.
    pub solve_s: f64,
    /// Wall time of the compilation, the geometry of the coverage above all.
    pub compile_s: f64,
}

impl Ours {
    /// Solves a scenario; its plan is checked.
    pub fn solve(scenario: &Scenario, arguments: &Arguments) -> Result<Self, Box<dyn Error>> {
        let (instance, compile_s) = timed(|| Instance::new(black_box(scenario)));
        let limit_s = arguments.solver_limit_s;
        let (outcome, solve_s) = timed(|| {
            let clock = Clock::start();
            let stop = |_: u64| clock.elapsed_s() >= limit_s;
            let options = Options { solver: arguments.solver, seed: 0, stop: &stop, policy: None };
            solve_compiled(black_box(&instance), &options)
        });
        let plan = outcome?.plan;
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

/// The result and the time of one long run, or the median time of several short ones.
fn timed<T>(work: impl Fn() -> T) -> (T, f64) {
    let run = || {
        let clock = Clock::start();
        let result = work();
        (result, clock.elapsed_s())
    };
    let (result, first_s) = run();
    if first_s > SHORT_S {
        return (result, first_s);
    }
    let mut times_s: Vec<f64> = (1..RUNS).map(|_| run().1).chain([first_s]).collect();
    times_s.sort_by(f64::total_cmp);
    (result, times_s[RUNS / 2])
}

struct Clock(Instant);

impl Clock {
    // The benchmark measures, so it needs the clock that the library must not read.
    #[allow(clippy::disallowed_methods)]
    fn start() -> Self {
        Self(Instant::now())
    }

    fn elapsed_s(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}
