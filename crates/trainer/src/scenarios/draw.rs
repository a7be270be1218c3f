//! Scenarios drawn from cells.

use rayon::prelude::*;
use voltour_solver::generate;
use voltour_solver::policy::Problem;
use voltour_solver::scenario::{Document, Scenario};

use crate::dqn::{index, stream, unit};
use crate::error::{Error, Result};

use super::{Cell, cells};

const CELL: u64 = 10;
const REQUESTS: u64 = 11;

/// What scenarios are for; no two draw the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// To learn from.
    Training,
    /// To watch the training and to choose among its networks.
    Validation,
    /// To say in the end how good it is.
    Test,
}

impl Split {
    /// Its scenarios have the seeds from here on.
    const fn first_seed(self) -> u64 {
        match self {
            Self::Training => 1_000_000_000,
            Self::Validation => 2_000_000_000,
            Self::Test => 3_000_000_000,
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
        let seed = split.first_seed() + seed * 10_000_000 + i;
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
