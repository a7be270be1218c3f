//! What the service runs: every solver that may help, under one budget; the entry keeps the best.

use rand_pcg::Pcg64Mcg;

use super::entry::{Claim, Found};
use super::{Budget, SolverName, baseline, greedy};
use crate::instance::Instance;

/// Greedy, then the baseline from the greedy's tour on.
pub fn auto(instance: &Instance<'_>, rng: &mut Pcg64Mcg, budget: &mut Budget<'_>) -> Vec<Found> {
    let order = greedy::greedy(instance, budget);
    let iterations = vec![("greedy".to_owned(), budget.iterations())];
    budget.done(SolverName::Greedy);
    let first = Found { order, solver: SolverName::Greedy, iterations, claim: Claim::None };
    let second = baseline::solve(instance, &first.order, rng, budget);
    budget.done(SolverName::Baseline);
    vec![first, second]
}
