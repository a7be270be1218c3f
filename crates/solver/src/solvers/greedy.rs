//! The greedy solvers: cheapest feasible insertion, and the paper's literal "nearest sensor".

use super::Budget;
use super::grow::{Rule, grow};
use super::partial::{Partial, gain};
use super::shortcut;
use crate::instance::Instance;
use crate::scenario::Objective;

/// Always inserts, at its cheapest legal place, the candidate with the most gain for its effort;
/// those that an open demand cannot do without come first.
pub fn greedy(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Vec<u32> {
    let pool: Vec<u32> = (0..instance.len() as u32).collect();
    let mut partial = Partial::new(instance, &shortcut::legal_start(instance));
    let weight = vec![1.0; instance.demands.demands.len()];
    let rule = Rule { weight: &weight, unit: unit(instance), must_first: true, power: 1.0 };
    grow(instance, &mut partial, &pool, &rule, || 1.0, Some(budget));
    partial.tour.order().to_vec()
}

/// Rewards beside demands: the mean candidate is worth one tenth of a missing cover.
fn unit(instance: &Instance<'_>) -> f64 {
    let total: f64 = (0..instance.len() as u32).map(|c| gain(instance, c)).sum();
    if total > 0.0 { 0.1 * instance.len() as f64 / total } else { 0.0 }
}

/// The paper's Greedy (section "Comparison Algorithms" of the optimal k-coverage charging problem): goes to
/// the nearest sensor in reach, until the demands are met or it is stuck.
///
/// Deviation: only to sensors that help, unless `literal`; the paper asks no more than an edge to a sensor that
/// was not visited. Its figures lie between the two, nearer the first.
pub fn nearest(instance: &Instance<'_>, literal: bool, budget: &mut Budget<'_>) -> Vec<u32> {
    append(instance, literal, budget, |open| {
        open.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(candidate, _)| candidate)
    })
}

/// Appends candidates chosen by `choose` among those that keep every limit and help, or where the walk is
/// `literal` among all that keep them, each with the distance to it; until nothing is left to help.
pub(super) fn append(
    instance: &Instance<'_>,
    literal: bool,
    budget: &mut Budget<'_>,
    mut choose: impl FnMut(&[(u32, f64)]) -> Option<u32>,
) -> Vec<u32> {
    let mut partial = Partial::new(instance, &[]);
    let weight = vec![1.0; instance.demands.demands.len()];
    let mut open = Vec::new();
    let mut here = instance.departure();
    let rewarded = instance.scenario.objective != Objective::MinDistance;
    while rewarded || partial.missing() > 0 {
        open.clear();
        for candidate in 0..instance.len() as u32 {
            let helps = rewarded || literal || partial.relief(instance, candidate, &weight) > 0.0;
            if partial.tour.serves(candidate) || !helps {
                continue;
            }
            let there = instance.step(&here, candidate);
            if instance.in_time(&there) && instance.keeps_limits(&instance.finish(&there)) {
                open.push((candidate, there.distance_m - here.distance_m));
            }
        }
        let Some(next) = choose(&open) else { break };
        here = instance.step(&here, next);
        partial.insert(instance, partial.tour.len(), next);
        if !budget.spend() {
            break;
        }
    }
    partial.tour.order().to_vec()
}
