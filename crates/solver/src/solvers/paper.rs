//! The paper's comparison algorithms: their options, whose problem is whose, and how an attempt ends.
//!
//! Every one of them takes limits of time and memory that may end it before it is finished: the paper's own
//! runs took up to five days.

use rand_pcg::Pcg64Mcg;

use super::acs::{AcsOptions, acs};
use super::app::{app, app_needs};
use super::cmst::cmst;
use super::dp::dp;
use super::entry::Unavailable;
use super::mst::mst;
use super::{Budget, SolverName};
use crate::instance::Instance;
use crate::scenario::Objective;

/// Options of the paper's algorithms; the defaults are the paper's where it names them.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperOptions {
    /// Memory that one of them may use, in bytes; it ends unfinished where that is not enough.
    pub memory_bytes: usize,
    /// `nearest` and `random` go to any sensor in reach, not only to those that help.
    pub literal: bool,
    /// Walks of `random`, the best of which is kept; the paper runs it "multiple times".
    pub walks: u32,
    /// Ant colony system.
    pub acs: AcsOptions,
    /// Step of the time of `dp`, in seconds.
    pub dp_step_s: f64,
    /// Recursion level of `app` where sensors are counted: a tour has up to 2^level - 1 stops.
    pub app_level: u32,
    /// Step of its time, in seconds (paper: 90, 180, 300).
    pub app_step_s: f64,
    /// It plans with charges to (1 - epsilon) of the scenario's level. The paper's 0.1 is in the level of
    /// the scenarios that [`crate::generate::mobile`] draws, so that nothing is left to take off.
    pub app_epsilon: f64,
}

impl Default for PaperOptions {
    fn default() -> Self {
        Self {
            memory_bytes: 1 << 30,
            literal: false,
            walks: 100,
            acs: AcsOptions::default(),
            dp_step_s: 1.0,
            app_level: 3,
            app_step_s: 300.0,
            app_epsilon: 0.0,
        }
    }
}

/// What ended an algorithm before it was finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfinished {
    /// The stop rule.
    Budget,
    /// The limit on its memory.
    Memory,
}

/// A legal tour, and whether the algorithm came to its end. `dp` and `app` have no tour before that.
#[derive(Clone, Debug)]
pub(super) struct Attempt {
    pub order: Vec<u32>,
    pub unfinished: Option<Unfinished>,
}

impl Attempt {
    /// Of an algorithm that came to its end.
    pub fn finished(order: Vec<u32>) -> Self {
        Self { order, unfinished: None }
    }

    /// Of one that has nothing to show.
    pub fn ended_by(limit: Unfinished) -> Self {
        Self { order: Vec::new(), unfinished: Some(limit) }
    }
}

/// Runs one of the algorithms; with the name of what its iterations count.
pub(super) fn solve(
    instance: &Instance<'_>,
    solver: SolverName,
    options: &PaperOptions,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Result<(Attempt, &'static str), Unavailable> {
    if let Some(needs) = unmet(instance, solver, options) {
        return Err(Unavailable { solver, needs });
    }
    Ok(match solver {
        SolverName::Acs => (acs(instance, options, rng, budget), "ants"),
        SolverName::Dp => (dp(instance, options, budget), "colour sets"),
        SolverName::Mst => (mst(instance, budget), "vertices"),
        SolverName::Cmst => (cmst(instance, budget), "mergers"),
        _ => (app(instance, options, budget), "sub-problems"),
    })
}

/// What the scenario or the options lack to be the solver's problem.
fn unmet(
    instance: &Instance<'_>,
    solver: SolverName,
    options: &PaperOptions,
) -> Option<&'static str> {
    let objective = instance.scenario.objective;
    let at_rest = !instance.moving;
    let shortest = objective == Objective::MinDistance && at_rest;
    let (holds, needs) = match solver {
        SolverName::Acs => (shortest, "the shortest tour to be sought, among sensors at rest"),
        SolverName::Dp => (
            shortest && instance.capacity_j.is_infinite() && is_step(options.dp_step_s),
            "the shortest tour to be sought, among sensors at rest, without a capacity, in steps above 0",
        ),
        SolverName::Mst | SolverName::Cmst => (
            objective == Objective::MaxReward && at_rest,
            "the largest reward to be sought, among sensors at rest",
        ),
        _ => return app_needs(instance, options),
    };
    (!holds).then_some(needs)
}

/// Whether time can advance by it.
pub(super) fn is_step(seconds: f64) -> bool {
    seconds > 0.0 && seconds.is_finite()
}

/// Those stops of an order, in this order, that a legal tour has room for, one after the other.
pub(super) fn fitted(instance: &Instance<'_>, order: &[u32]) -> Vec<u32> {
    let mut run = instance.departure();
    let fits = |&candidate: &u32| {
        let there = instance.step(&run, candidate);
        let legal = instance.in_time(&there) && instance.keeps_limits(&instance.finish(&there));
        if legal {
            run = there;
        }
        legal
    };
    order.iter().copied().filter(fits).collect()
}
