//! [`Job`]: one scenario and who is to solve it.

use std::fs;
use std::path::PathBuf;

use voltour_solver::generate::{Cell, FIRST_TEST_SEED};
use voltour_solver::scenario::Scenario;

use super::{BenchError, Entrant};

/// Seeds of a bench are this far apart from those of another: scenarios of a cell are fewer.
const SEEDS_APART: u64 = 1 << 20;

/// One scenario, to be solved by each of the entrants.
#[derive(Clone, Debug)]
pub struct Job {
    /// Where it comes from.
    pub source: Source,
    /// Which of its group it is.
    pub index: u64,
    /// Who solves it.
    pub entrants: Vec<Entrant>,
}

/// Where a scenario comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// Drawn, by the index of the job.
    Cell {
        /// The family.
        cell: Cell,
        /// Seed of the bench.
        seed: u64,
    },
    /// A document.
    File(PathBuf),
}

impl Job {
    /// The name that its runs are kept under: the cell, or the file.
    pub fn group(&self) -> String {
        match &self.source {
            Source::Cell { cell, .. } => cell.to_string(),
            Source::File(path) => {
                path.file_name().map_or_else(String::new, |name| name.display().to_string())
            }
        }
    }

    /// The scenario.
    ///
    /// # Errors
    /// It cannot be drawn or read.
    pub fn scenario(&self) -> Result<Scenario, BenchError> {
        match &self.source {
            Source::Cell { cell, seed } => {
                let failed = |error: &dyn std::fmt::Display| BenchError::Scenario {
                    scenario: format!("{cell}, scenario {}", self.index),
                    problem: error.to_string(),
                };
                let seed = FIRST_TEST_SEED + seed * SEEDS_APART + self.index;
                let document = cell.draw(seed).map_err(|error| failed(&error))?;
                Scenario::from_document(&document).map_err(|error| failed(&error))
            }
            Source::File(path) => {
                let text = fs::read(path).map_err(BenchError::file(path))?;
                Scenario::from_json(&text).map_err(|error| BenchError::content(path, error))
            }
        }
    }
}
