//! What the service runs: every solver that may help, under one budget; the entry keeps the best.

use rand_pcg::Pcg64Mcg;

use super::entry::{Claim, Found, is_optimal};
use super::{Budget, SolverName, baseline, exact, greedy};
use crate::instance::Instance;

/// Greedy; from its tour on a proof, with as much work as the size of the instance makes worth it; and, where
/// that does not end, the baseline from the proof's tour on.
pub fn auto(instance: &Instance<'_>, rng: &mut Pcg64Mcg, budget: &mut Budget<'_>) -> Vec<Found> {
    let order = greedy::greedy(instance, budget);
    let iterations = vec![("greedy".to_owned(), budget.iterations())];
    budget.done(SolverName::Greedy);
    let first = Found { order, solver: SolverName::Greedy, iterations, claim: Claim::None };
    let second = exact::solve(instance, &first.order, exact::Effort::Share, rng, budget);
    budget.done(SolverName::Exact);
    if is_optimal(instance, &second) {
        return vec![first, second];
    }
    let third = baseline::solve(instance, &second.order, rng, budget);
    budget.done(SolverName::Baseline);
    vec![first, second, third]
}
