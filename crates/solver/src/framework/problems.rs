//! The three problems of the paper.

use super::{Action, Definition, Insert, State};
use crate::policy::Problem;

/// The definition of a problem.
pub fn definition(problem: Problem) -> &'static dyn Definition {
    match problem {
        Problem::KCoverage => &KCoverage,
        Problem::Reward => &Reward,
        Problem::Mobile => &Mobile,
    }
}

/// Optimal k-coverage charging: the shortest tour that keeps the area covered. Best feasible insertion;
/// the reward is the negative detour; it stops when every demand is met.
#[derive(Clone, Copy, Debug)]
pub struct KCoverage;

impl Definition for KCoverage {
    fn name(&self) -> &'static str {
        Problem::KCoverage.name()
    }

    fn insertion(&self) -> Insert {
        Insert::Cheapest
    }

    fn objective(&self, state: &State<'_>) -> f64 {
        -state.tour().finished().distance_m / state.scales().length_m
    }

    fn reward(&self, state: &State<'_>, _candidate: u32, place: &Action) -> f64 {
        -place.insertion.effort / state.scales().length_m
    }

    fn stops(&self, state: &State<'_>) -> bool {
        state.open_demands() == 0
    }
}

/// Fully charging reward maximisation: the largest prize for the charger's energy. Cheapest insertion;
/// the reward is the prize; it stops when nothing fits any more.
#[derive(Clone, Copy, Debug)]
pub struct Reward;

impl Definition for Reward {
    fn name(&self) -> &'static str {
        Problem::Reward.name()
    }

    fn insertion(&self) -> Insert {
        Insert::Cheapest
    }

    fn objective(&self, state: &State<'_>) -> f64 {
        state.tour().reward(state.instance()) / state.scales().gain
    }

    fn reward(&self, state: &State<'_>, candidate: u32, _place: &Action) -> f64 {
        state.instance().candidates[candidate as usize].reward / state.scales().gain
    }

    fn stops(&self, _state: &State<'_>) -> bool {
        false
    }
}

/// Mobile network charging path: the most sensors in the time span. Appended; each counts one; it stops
/// when none can be charged in time.
#[derive(Clone, Copy, Debug)]
pub struct Mobile;

impl Definition for Mobile {
    fn name(&self) -> &'static str {
        Problem::Mobile.name()
    }

    fn insertion(&self) -> Insert {
        Insert::Append
    }

    fn objective(&self, state: &State<'_>) -> f64 {
        state.tour().len() as f64
    }

    fn reward(&self, _state: &State<'_>, _candidate: u32, _place: &Action) -> f64 {
        1.0
    }

    fn stops(&self, _state: &State<'_>) -> bool {
        false
    }
}
