//! One request that may become a stop: its window, its charge as a function of the arrival, its worth.

use crate::scenario::{Point, Request, Scenario};
use crate::tolerance::solver_limit;

/// A request that is not already charged.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Index into the scenario's requests.
    pub request: usize,
    /// Where it is at rest; for a moving sensor, where it is at time 0.
    pub point: Point,
    /// Charging may not begin before it, in seconds.
    pub ready_s: f64,
    /// Charging must begin by then: the deadline with a solver's share of the tolerance; infinite if none.
    pub due_s: f64,
    /// Energy left at time 0, in joules.
    pub residual_j: f64,
    /// Energy to which it is charged, in joules, more than `residual_j`.
    pub target_j: f64,
    /// Consumption in watts.
    pub drain_w: f64,
    /// What serving it is worth.
    pub reward: f64,
    /// The tour must serve it.
    pub required: bool,
}

impl Candidate {
    pub(super) fn new(scenario: &Scenario, index: usize, request: &Request) -> Self {
        Self {
            request: index,
            point: scenario.sensors[request.sensor].place.at(0.0),
            ready_s: request.ready_s,
            due_s: request.deadline_s.map_or(f64::INFINITY, solver_limit),
            residual_j: request.residual_j,
            target_j: scenario.target_j(request),
            drain_w: request.drain_w,
            reward: request.reward,
            required: request.required,
        }
    }

    /// Energy delivered where charging begins at `arrive_s`, in joules.
    #[inline]
    pub fn charge_j(&self, arrive_s: f64) -> f64 {
        self.target_j - (self.residual_j - self.drain_w * arrive_s).max(0.0)
    }

    /// When the sensor runs empty, from where on its charge no longer grows; infinite without drain.
    pub fn empty_s(&self) -> f64 {
        if self.drain_w > 0.0 { self.residual_j / self.drain_w } else { f64::INFINITY }
    }
}
