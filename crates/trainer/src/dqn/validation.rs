//! Validation: greedy episodes on fixed scenarios whose optimum is proven.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use voltour_solver::gap::gap;
use voltour_solver::instance::Instance;
use voltour_solver::plan::Status;
use voltour_solver::policy::Problem;
use voltour_solver::solvers::{Options, SolverName, solve_compiled};
use voltour_solver::stop::MaxIterations;
use voltour_solver::tour::Value;

use crate::network::Network;

use super::{Play, complete};

/// A scenario of the validation set.
#[derive(Clone)]
pub struct Trial<'a> {
    /// Its episode at the beginning.
    pub play: Play<'a>,
    /// The least cost of a tour: its length, or what it gains with the sign turned.
    pub optimum: f64,
}

/// How good a policy is on a validation set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// Mean gap over the scenarios for which a tour was found, `|f - f*| / |f*|`.
    pub gap: f64,
    /// The share of the scenarios for which a tour was found.
    pub feasible: f64,
    /// The number of scenarios.
    pub trials: usize,
}

/// The instances whose optimum the exact solver proves within so many iterations each.
pub fn trials<'a>(
    instances: &'a [Instance<'a>],
    problem: Problem,
    iterations: u64,
) -> Vec<Trial<'a>> {
    let prove = |instance: &'a Instance<'a>| {
        let play = Play::new(instance, problem);
        let stop = MaxIterations(iterations);
        let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
        let plan = solve_compiled(instance, &options).ok()?.plan;
        let optimum = match problem {
            Problem::KCoverage => plan.objective,
            Problem::Reward | Problem::Mobile => -plan.objective,
        };
        let proven = plan.status == Status::Optimal && !play.episode.is_over();
        proven.then_some(Trial { play, optimum })
    };
    instances.par_iter().filter_map(prove).collect()
}

/// The score of the greedy policy.
pub fn validate(network: &Network, trials: &[Trial<'_>]) -> Score {
    let run = |trial: &Trial<'_>| {
        let mut play = trial.play.clone();
        complete(network, &mut play);
        let state = play.episode.state();
        let value = Value::of(state.instance(), state.tour());
        let feasible = state.tour().is_legal() && value.is_feasible();
        let status = if feasible { Status::Feasible } else { Status::BestEffort };
        gap(status, value.cost, Some(trial.optimum))
    };
    let gaps: Vec<Option<f64>> = trials.par_iter().map(run).collect();
    let found: Vec<f64> = gaps.into_iter().flatten().collect();
    let mean = found.iter().sum::<f64>() / found.len().max(1) as f64;
    Score {
        gap: mean,
        feasible: found.len() as f64 / trials.len().max(1) as f64,
        trials: trials.len(),
    }
}
