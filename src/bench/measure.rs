//! One algorithm on one scenario. Times are processor time of the thread, so that other threads do not count.

use std::cell::Cell;

use cpu_time::ThreadTime;
use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::plan::Status;
use voltour_solver::policy::QFunction;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, PolicyUse, SolverName, Unfinished, solve_with};
use voltour_solver::stop::Limit;

use super::{BenchError, Ended, Entrant, Run, Settings};
use crate::clock::{Clock, SystemClock};

/// Bytes of a MiB.
const MIB: usize = 1 << 20;

/// A scenario, ready to be solved.
pub struct Prepared<'a> {
    group: &'a str,
    index: u64,
    scenario: &'a Scenario,
    instance: Instance<'a>,
    compile_s: f64,
}

impl<'a> Prepared<'a> {
    /// Builds the graph, and takes the time.
    pub fn new(group: &'a str, index: u64, scenario: &'a Scenario) -> Self {
        let begin = ThreadTime::now();
        let instance = Instance::new(scenario);
        let compile_s = begin.elapsed().as_secs_f64();
        Self { group, index, scenario, instance, compile_s }
    }

    /// Lets an algorithm solve it, and checks the plan.
    ///
    /// # Errors
    /// The algorithm is not for this scenario, or its plan does not hold.
    pub fn measure(
        &self,
        entrant: &Entrant,
        settings: &Settings,
        policy: Option<&dyn QFunction>,
    ) -> Result<Run, BenchError> {
        let most =
            if entrant.solver == SolverName::Baseline { settings.iterations } else { u64::MAX };
        let begin = ThreadTime::now();
        let spent_s = || begin.elapsed().as_secs_f64();
        let ran_s = || SystemClock.ran().as_secs_f64();
        let limit = Limit::new(settings.time_limit_s, spent_s, ran_s);
        let late = Cell::new(false);
        let stop = |done: u64| {
            late.set(limit.is_over());
            done >= most || late.get()
        };
        let options = Options { solver: entrant.solver, seed: settings.seed, stop: &stop, policy };
        let memory = (settings.memory_mib as usize).saturating_mul(MIB);
        let outcome = solve_with(&self.instance, &options, &entrant.options(memory));
        let seconds = spent_s();
        let outcome = outcome.map_err(|error| BenchError::Scenario {
            scenario: self.name(),
            problem: error.to_string(),
        })?;
        if let Some(broken) = check(self.scenario, &outcome.plan).first() {
            return Err(BenchError::Defect {
                scenario: self.name(),
                algorithm: entrant.to_string(),
                problem: broken.to_string(),
            });
        }
        // Where the policy built nothing, the tour is another solver's.
        let built = entrant.solver != SolverName::Dqn || outcome.policy == PolicyUse::Built;
        let ended = match outcome.unfinished {
            Some(Unfinished::Memory) => Ended::Memory,
            _ if late.get() => Ended::Time,
            _ => Ended::Itself,
        };
        Ok(Run {
            group: self.group.to_owned(),
            index: self.index,
            algorithm: entrant.to_string(),
            status: if built { outcome.plan.status } else { Status::BestEffort },
            objective: outcome.plan.objective,
            bound: outcome.plan.bound,
            stops: outcome.plan.stops.len(),
            seconds,
            compile_s: self.compile_s,
            ended,
        })
    }

    fn name(&self) -> String {
        format!("{}, scenario {}", self.group, self.index)
    }
}
