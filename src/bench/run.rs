//! [`Run`]: what one algorithm did on one scenario.

use serde::{Deserialize, Serialize};
use voltour_solver::plan::Status;

/// One row of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Cell or file of the scenario.
    pub group: String,
    /// Which scenario of that cell.
    pub index: u64,
    /// Name of the entrant.
    pub algorithm: String,
    /// What is known of its tour.
    pub status: Status,
    /// Objective of its tour, in the units of the plan document.
    pub objective: f64,
    /// Proven bound on every tour, where there is one.
    pub bound: Option<f64>,
    /// Stops of the tour.
    pub stops: usize,
    /// Processor time of the solver, in seconds.
    pub seconds: f64,
    /// Processor time before that, the same for every solver: building the graph, in seconds.
    pub compile_s: f64,
    /// What ended it.
    pub ended: Ended,
}

/// What ended an algorithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// Its own rule: what it found depends on the seed alone.
    Itself,
    /// The limit on its time: what it found depends on the machine.
    Time,
    /// The limit on its memory.
    Memory,
}

impl Run {
    /// Whether it found a tour that keeps every constraint.
    pub fn solved(&self) -> bool {
        self.status.is_feasible()
    }

    /// The objective of such a tour.
    pub fn found(&self) -> Option<f64> {
        self.solved().then_some(self.objective)
    }
}
