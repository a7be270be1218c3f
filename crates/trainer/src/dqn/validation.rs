//! Validation: greedy episodes on fixed scenarios whose optimum is proven.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use voltour_solver::gap::gap;
use voltour_solver::plan::Status;

use crate::network::Network;

use super::{Episode, complete};

/// A scenario of the validation set.
#[derive(Clone, Debug)]
pub struct Trial<E> {
    /// Its episode at the beginning.
    pub episode: E,
    /// The proven optimum of the objective f, which is to be maximised.
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

/// The score of the greedy policy.
pub fn validate<E: Episode>(network: &Network, trials: &[Trial<E>]) -> Score {
    let run = |trial: &Trial<E>| {
        let mut episode = trial.episode.clone();
        complete(network, &mut episode);
        let outcome = episode.outcome();
        let status = if outcome.feasible { Status::Feasible } else { Status::BestEffort };
        gap(status, outcome.objective, Some(trial.optimum))
    };
    let gaps: Vec<Option<f64>> = trials.par_iter().map(run).collect();
    let found: Vec<f64> = gaps.into_iter().flatten().collect();
    let mean = found.iter().sum::<f64>() / found.len().max(1) as f64;
    Score { gap: mean, feasible: found.len() as f64 / trials.len().max(1) as f64, trials: trials.len() }
}
