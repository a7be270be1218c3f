//! The solver `exact`: the baseline's tour first, then the proof that it, or a better one, is the best.

use rand_pcg::Pcg64Mcg;

use super::effort::First;
use super::{Aim, Effort, Incumbent, Model, prove};
use crate::instance::Instance;
use crate::scenario::Objective;
use crate::solvers::entry::{Claim, Found};
use crate::solvers::{Budget, SolverName, baseline, enumerate};
use crate::tour::{Tour, Value};

/// Iterations of the baseline for a tour that breaks as little as can be.
const BEST_EFFORT: u64 = 2_000;
/// Iterations of the baseline that make a proven tour shorter, or earlier, without changing its objective.
const POLISH: u64 = 100;
/// The same where sensors move and an iteration takes long.
const MOVING_POLISH: u64 = 20;

/// The best tour with its proof, or what is known when the budget ends. `start` is a legal tour to begin
/// with; it may be empty.
pub fn solve(
    instance: &Instance<'_>,
    start: &[u32],
    effort: Effort,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Found {
    let before = budget.iterations();
    let mut first = First::of(effort, instance, start);
    let mut order = improved(instance, start, first.iterations, rng, budget);
    let mut claim = Claim::None;
    if !is_feasible(instance, &order) {
        let model = Model::new(instance, Aim::AnyTour);
        let mut any = Incumbent::none(&model);
        let proof = prove(&model, effort, &mut any, rng, budget);
        match proof.order {
            Some(feasible) => (order, first.whole) = (feasible, false),
            None => {
                if proof.closed && any.beyond == f64::INFINITY {
                    claim = Claim::Infeasible;
                }
                // What cannot be done whole is done as far as it goes.
                order = polished(instance, &order, BEST_EFFORT, rng, budget);
            }
        }
    }
    if claim == Claim::None {
        let model = Model::new(instance, Aim::Optimum);
        let mut incumbent = Incumbent::none(&model);
        incumbent.offer(&model, order.clone());
        incumbent.searched = first.whole;
        let proof = prove(&model, effort, &mut incumbent, rng, budget);
        claim = match (proof.order, proof.closed) {
            (Some(best), _) => {
                order = best;
                if proof.closed && instance.scenario.objective != Objective::MinDistance {
                    let most = if instance.moving { MOVING_POLISH } else { POLISH };
                    order = polished(instance, &order, most, rng, budget);
                }
                Claim::Bound(objective(instance, proof.bound))
            }
            (None, true) if incumbent.beyond == f64::INFINITY => Claim::Infeasible,
            (None, _) => Claim::Bound(objective(instance, proof.bound)),
        };
    }
    let iterations = vec![("proof".to_owned(), budget.iterations() - before)];
    Found { order, solver: SolverName::Exact, iterations, claim }
}

/// The best of all tours where they are few; else the tour after some iterations of the baseline.
fn polished(
    instance: &Instance<'_>,
    order: &[u32],
    iterations: u64,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Vec<u32> {
    if instance.len() > enumerate::MOST {
        return improved(instance, order, iterations, rng, budget);
    }
    let found = baseline::solve(instance, order, rng, budget).order;
    let value = |order: &[u32]| Value::of(instance, &Tour::new(instance, order));
    if value(&found).beats(&value(order)) { found } else { order.to_vec() }
}

/// The tour after some iterations of the baseline, or as it was if they make it no better.
fn improved(
    instance: &Instance<'_>,
    order: &[u32],
    iterations: u64,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Vec<u32> {
    // A construction cut short would be worse than one made with less time: it is finished first.
    let built = if order.is_empty() { baseline::construction(instance) } else { 0 };
    let known = (built == 0).then_some(iterations);
    budget.part(built, built + iterations, |part| {
        baseline::search(instance, order, known, rng, part).order
    })
}

pub(super) fn is_feasible(instance: &Instance<'_>, order: &[u32]) -> bool {
    let tour = Tour::new(instance, order);
    tour.is_legal() && Value::of(instance, &tour).is_feasible()
}

/// A bound on the cost as a bound on the objective.
fn objective(instance: &Instance<'_>, cost: f64) -> f64 {
    match instance.scenario.objective {
        Objective::MinDistance => cost.max(0.0),
        Objective::MaxReward => (-cost).min(instance.candidates.iter().map(|c| c.reward).sum()),
        Objective::MaxCount => (1e-6 - cost).floor().min(instance.len() as f64),
    }
}
