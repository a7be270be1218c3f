//! [`Point`]: a training at one moment.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::file::write_atomically;

/// A point of the learning curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Gradient steps so far.
    pub step: u64,
    /// Seconds of training so far.
    pub seconds: f64,
    /// Mean loss of a sample since the point before.
    pub loss: f64,
    /// The share of random actions.
    pub epsilon: f64,
    /// Mean sum of the rewards of an episode since the point before.
    pub total: f64,
    /// Mean gap of the greedy policy on the validation set.
    pub gap: f64,
    /// The share of the validation set for which it found a tour.
    pub feasible: f64,
}

impl Point {
    /// What validation compares networks by: the mean gap, 100 % where no tour was found.
    pub fn cost(&self) -> f64 {
        self.feasible * self.gap + (1.0 - self.feasible)
    }
}

/// Writes `curve.csv` and `curve.svg` into a directory.
///
/// # Errors
/// A file cannot be written.
pub fn save(directory: &Path, title: &str, curve: &[Point]) -> Result<()> {
    write_atomically(&directory.join("curve.csv"), super::csv::table(curve).as_bytes())?;
    write_atomically(&directory.join("curve.svg"), super::svg::chart(title, curve)?.as_bytes())
}
