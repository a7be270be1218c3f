//! Scenarios drawn from cells.

use rand_pcg::rand_core::Rng;
use rayon::prelude::*;
use voltour_solver::generate::{self, Cell};
use voltour_solver::policy::Problem;
use voltour_solver::scenario::{Document, Scenario};

use crate::dqn::{index, stream, unit};
use crate::error::{Error, Result};

use super::cells;

const SCENARIO: u64 = 9;
const CELL: u64 = 10;
const REQUESTS: u64 = 11;

/// What scenarios are for; no two draw the same, and neither draws what measures a policy in the end
/// ([`voltour_solver::generate::FIRST_TEST_SEED`] and on).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// To learn from.
    Training,
    /// To watch the training and to choose among its networks.
    Validation,
}

impl Split {
    /// The seed of its `i`-th scenario in a training with that seed.
    fn seed(self, seed: u64, i: u64) -> u64 {
        match self {
            Self::Validation => (1 << 20) + i,
            Self::Training => (1 << 32) + u64::from(stream(seed, SCENARIO, i).next_u32()),
        }
    }
}

/// `deployments` places of sensors, each with `redraws` sets of requests (k-coverage; elsewhere a deployment costs
/// nothing, and each scenario has its own).
///
/// # Errors
/// A cell cannot be drawn from.
pub fn draw(
    problem: Problem,
    split: Split,
    seed: u64,
    deployments: u64,
    redraws: u64,
) -> Result<Vec<Scenario>> {
    let cells = cells(problem);
    let failed = |e: &dyn std::fmt::Display| Error::Scenario(e.to_string());
    let deploy = |i: u64| {
        let cell = &cells[index(&mut stream(seed, CELL, i), cells.len())];
        let seed = split.seed(seed, i);
        let documents = match cell {
            Cell::KCoverage(options) => {
                let document = generate::k_coverage(options, seed).map_err(|e| failed(&e))?;
                (0..redraws).map(|r| requests(&document, options, seed, r)).collect()
            }
            Cell::Reward(options) => vec![generate::reward(options, seed).map_err(|e| failed(&e))?],
            Cell::Mobile(options) => vec![generate::mobile(options, seed).map_err(|e| failed(&e))?],
        };
        let read = |d: &Document| Scenario::from_document(d).map_err(|e| failed(&e));
        documents.iter().map(read).collect::<Result<Vec<_>>>()
    };
    let count = if problem == Problem::KCoverage { deployments } else { deployments * redraws };
    let drawn = (0..count).into_par_iter().map(deploy).collect::<Result<Vec<_>>>()?;
    Ok(drawn.into_iter().flatten().collect())
}

/// The deployment with other requests, drawn as the generator draws them; the first redraw is its own.
fn requests(
    document: &Document,
    options: &generate::KCoverage,
    seed: u64,
    redraw: u64,
) -> Document {
    let mut document = document.clone();
    if redraw == 0 {
        return document;
    }
    let mut rng = stream(seed, REQUESTS, redraw);
    let mut between = |low: f64, high: f64| low + (high - low) * unit(&mut rng);
    let request = |sensor: &voltour_solver::scenario::SensorDocument| {
        let residual_j = between(options.residual_above_j, options.battery_j);
        let drain_w = between(options.drain_min_w, options.drain_max_w);
        (residual_j <= options.alpha * options.battery_j).then(|| {
            voltour_solver::scenario::RequestDocument {
                sensor: sensor.id.clone(),
                ready_s: None,
                deadline_s: Some(residual_j / drain_w),
                residual_j: Some(residual_j),
                drain_w: Some(drain_w),
                reward: None,
                required: None,
            }
        })
    };
    document.requests = document.sensors.iter().filter_map(request).collect();
    document
}
