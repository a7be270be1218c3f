//! A bound in a fraction of a second where a proof is out of reach: hundreds and thousands of requests.

use super::clusters::{First, clusters};
use super::pricing::most_gain;
use super::spanning::spanning;
use super::{Aim, Model, Places};
use crate::instance::Instance;
use crate::scenario::Objective;

/// How many prices of what is scarce are tried, at most, where gains count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    /// As many as make the bound better.
    Whole,
    /// A few: for one whose time is over.
    Little,
}

/// No tour that the check accepts costs less: metres, or negated rewards; infinite if the demands cannot
/// be met at all. Work is capped by counts, quadratic in the candidates. An infinite `incumbent_cost` says
/// that no tour is known; a known one only tells where to look.
pub fn quick(model: &Model<'_>, incumbent_cost: f64, care: Care) -> f64 {
    let instance = &model.wide;
    let places = Places::new(model);
    let Some(sets) = clusters(model, &places, First::Few) else { return f64::INFINITY };
    if model.length_counts {
        let tree = |sets: &[Vec<u32>]| {
            spanning(&places, sets, instance.start(), instance.end(), incumbent_cost)
        };
        let bound = tree(&sets);
        if sets.iter().all(|set| set.len() == 1) && sets.len() == model.demands.len() {
            return bound;
        }
        return clusters(model, &places, First::Close).map_or(bound, |sets| tree(&sets).max(bound));
    }
    let most = most_gain(model, &places, -incumbent_cost, care);
    let counts = instance.scenario.objective == Objective::MaxCount;
    -if counts { (most + 1e-6).floor() } else { most }
}

/// The bound without paths on the objective, where `known` is that of a feasible tour. None says that no tour
/// meets what must be served.
pub fn quick_bound(instance: &Instance<'_>, known: Option<f64>) -> Option<f64> {
    let model = Model::new(instance, Aim::Optimum);
    let sign = if model.length_counts { 1.0 } else { -1.0 };
    let cost = known.map_or(f64::INFINITY, |objective| sign * objective);
    let bound = quick(&model, cost, Care::Whole);
    bound.is_finite().then_some(sign * bound)
}
