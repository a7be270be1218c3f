//! What the service runs: every solver that may help, under one budget; the entry keeps the best.

use rand_pcg::Pcg64Mcg;

use super::entry::{Claim, Found, PolicyUse, is_optimal};
use super::{Budget, SolverName, baseline, dqn, exact, greedy};
use crate::instance::Instance;
use crate::policy::QFunction;
use crate::policy::guided::Effort;
use crate::tour::{Tour, Value};

/// Greedy and, where there is one, the policy's construction; from the better tour on a proof, with as much
/// work as the size of the instance makes worth it; and, where that does not end, the baseline from the
/// proof's tour on.
pub fn auto(
    instance: &Instance<'_>,
    policy: Option<&dyn QFunction>,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> (Vec<Found>, PolicyUse) {
    let order = greedy::greedy(instance, budget);
    let iterations = vec![("greedy".to_owned(), budget.iterations())];
    budget.done(SolverName::Greedy);
    let mut found =
        vec![Found { order, solver: SolverName::Greedy, iterations, claim: Claim::None }];
    let (built, fared) = dqn::dqn(instance, policy, Effort::SHARE, rng, budget);
    budget.done(SolverName::Dqn);
    found.extend(built);
    let value = |found: &&Found| Value::of(instance, &Tour::new(instance, &found.order));
    let better = found.iter().min_by(|a, b| value(a).compare(&value(b)));
    let start = better.map_or_else(Vec::new, |found| found.order.clone());
    let proof = exact::solve(instance, &start, exact::Effort::Share, rng, budget);
    budget.done(SolverName::Exact);
    if is_optimal(instance, &proof) {
        found.push(proof);
        return (found, fared);
    }
    let improved = baseline::solve(instance, &proof.order, rng, budget);
    budget.done(SolverName::Baseline);
    found.extend([proof, improved]);
    (found, fared)
}
