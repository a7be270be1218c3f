//! [`Method`]: a way to build a tour, by name, so that the policy and its control can be compared.

use std::fmt;
use std::str::FromStr;

use cpu_time::ThreadTime;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use voltour_solver::framework::definition;
use voltour_solver::instance::Instance;
use voltour_solver::local_search::{Neighbours, descend};
use voltour_solver::policy::guided::{Effort, Guide, Kept, Rule};
use voltour_solver::policy::{Problem, QError, QFunction};
use voltour_solver::scenario::Objective;
use voltour_solver::solvers::{Budget, Options, SolverName, solve_compiled};
use voltour_solver::stop::Limit;
use voltour_solver::tour::Tour;

use crate::stopwatch::Stopwatch;

/// How the control's noise compares with its values: that many times the mean length, or the mean ratio.
const CONTROL_TEMPERATURE: f64 = 0.3;

/// Orders of `+order`.
const ORDERS: usize = 16;

/// A way to build a tour: `[control-]WHAT[+order[N]][+search]`, or the name of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    name: String,
    way: Way,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Guided {
        /// By the untrained rule in place of the policy.
        control: bool,
        /// `None`: that of the solver `dqn`, which differs by problem.
        effort: Option<Effort>,
        /// Orders in which stops are put in again, if it names any.
        orders: Option<usize>,
        /// Local search on the best tour.
        search: bool,
        /// Samples until as much processor time is spent as the method before took.
        as_long: bool,
    },
    Solver(SolverName),
}

/// The methods of an ablation, in the order of its table.
pub const METHODS: [&str; 24] = [
    "control-greedy",
    "greedy",
    "control-greedy+order",
    "greedy+order",
    "greedy+search",
    "control-sample32",
    "sample32",
    "control-sample32+order",
    "sample32+order",
    "sample32+order+search",
    "control-beam32",
    "beam32",
    "control-beam32+order",
    "beam32+order",
    "beam32+order+search",
    "control-look8",
    "look8",
    "control-look8+order",
    "look8+order",
    "control-whole",
    "whole",
    "control-as-long",
    "baseline",
    "auto",
];

/// The text names no method.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "unknown method {0:?}; a method is [control-]WHAT[+order[N]][+search] with greedy, sampleN, beamN, lookN, whole or as-long for WHAT, or the name of a solver"
)]
pub struct UnknownMethod(String);

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(text: &str) -> Result<Self, UnknownMethod> {
        let name = text.to_owned();
        if let Ok(solver) = text.parse() {
            // `greedy` is here the policy's greedy roll-out.
            if solver != SolverName::Greedy {
                return Ok(Self { name, way: Way::Solver(solver) });
            }
        }
        let mut parts = text.split('+');
        let what = parts.next().unwrap_or_default();
        let (control, what) = match what.strip_prefix("control-") {
            Some(what) => (true, what),
            None => (false, what),
        };
        let digits = what.trim_start_matches(|c: char| !c.is_ascii_digit());
        let number = || digits.parse::<usize>().map_err(|_| UnknownMethod(text.to_owned()));
        let none = Effort { greedy: 0, ..Effort::GREEDY };
        let effort = match what.trim_end_matches(|c: char| c.is_ascii_digit()) {
            "greedy" => Some(Effort::GREEDY),
            "sample" => {
                let temperature = Effort::SHARE.temperature;
                Some(Effort { samples: number()?, temperature, ..none })
            }
            "beam" => Some(Effort { beam: number()?, ..none }),
            "look" => Some(Effort { look_ahead: number()?, ..none }),
            "whole" | "as-long" => None,
            _ => return Err(UnknownMethod(text.to_owned())),
        };
        let (mut search, mut orders, as_long) = (false, None, what == "as-long");
        for part in parts {
            match part {
                "search" => search = true,
                "order" => orders = Some(ORDERS),
                _ => {
                    let given = part.strip_prefix("order").and_then(|n| n.parse().ok());
                    orders = Some(given.ok_or_else(|| UnknownMethod(text.to_owned()))?);
                }
            }
        }
        Ok(Self { name, way: Way::Guided { control, effort, orders, search, as_long } })
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name)
    }
}

/// What a method gave on a scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Objective of its tour; `None` if that is not feasible.
    pub objective: Option<f64>,
    /// Complete roll-outs.
    pub roll_outs: u64,
    /// States that the Q-function valued.
    pub valued: u64,
    /// Processor time in seconds.
    pub seconds: f64,
}

impl Method {
    /// Builds a tour. `limit_s` bounds the processor time of a solver; `as_long_s` is what the method before
    /// took.
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn run(
        &self,
        instance: &Instance<'_>,
        policy: &dyn QFunction,
        seed: u64,
        limit_s: f64,
        as_long_s: f64,
    ) -> Result<Run, QError> {
        let begin = ThreadTime::now();
        let spent = || begin.elapsed().as_secs_f64();
        let problem = Problem::of(instance.scenario.objective);
        match self.way {
            Way::Solver(solver) => {
                let watch = Stopwatch::start();
                let stop = Limit::new(limit_s, spent, || watch.seconds());
                let options = Options { solver, seed, stop: &stop, policy: Some(policy) };
                let outcome = solve_compiled(instance, &options)
                    .map_err(|error| QError::Failed(error.to_string()))?;
                let plan = outcome.plan;
                let roll_outs = outcome.contenders.iter().filter(|c| c.solver == "dqn");
                Ok(Run {
                    objective: plan.status.is_feasible().then_some(plan.objective),
                    roll_outs: roll_outs.map(|c| c.iterations).sum(),
                    valued: 0,
                    seconds: spent(),
                })
            }
            Way::Guided { control, effort, orders, search, as_long } => {
                let mut effort = effort.unwrap_or_else(|| Effort::whole(problem));
                if control {
                    effort.temperature = CONTROL_TEMPERATURE;
                }
                if let Some(orders) = orders {
                    effort = Effort { orders, orders_grow: false, ..effort };
                }
                let rule = Rule(problem);
                let q: &dyn QFunction = if control { &rule } else { policy };
                let guide = Guide::new(instance, definition(problem), q);
                let mut kept = Kept::nothing(instance);
                let mut rng = Pcg64Mcg::seed_from_u64(seed);
                let stop = |_| as_long && spent() >= as_long_s;
                let samples = if as_long { usize::MAX } else { effort.samples };
                let effort = Effort { samples, ..effort };
                guide.construct(effort, &mut rng, &mut Budget::new(&stop), &mut kept)?;
                if search {
                    improve(instance, &mut kept);
                }
                let minimised = instance.scenario.objective == Objective::MinDistance;
                let objective = if minimised { kept.value.cost } else { -kept.value.cost };
                Ok(Run {
                    objective: kept.value.is_feasible().then_some(objective),
                    roll_outs: kept.roll_outs,
                    valued: guide.valued(),
                    seconds: spent(),
                })
            }
        }
    }
}

/// Local search on the best tour.
fn improve(instance: &Instance<'_>, kept: &mut Kept) {
    const MOVES: usize = 10_000;
    let mut tour = Tour::new(instance, &kept.order);
    let mut dirty = kept.order.clone();
    descend(instance, &mut tour, &mut Neighbours::new(instance), &mut dirty, MOVES);
    kept.offer(instance, &tour);
}
