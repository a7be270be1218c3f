//! The policy's construction alone: roll-outs that a trained Q-function guides, and re-insertion of the
//! stops they choose. No local search.

use rand_pcg::Pcg64Mcg;

use super::entry::{Claim, Found, PolicyUse};
use super::{Budget, SolverName};
use crate::framework::definition;
use crate::instance::Instance;
use crate::policy::guided::{Effort, Guide, Kept};
use crate::policy::{Problem, QFunction};

/// The best tour of the construction, and how the policy fared; without a feasible tour nothing is found.
pub fn dqn(
    instance: &Instance<'_>,
    policy: Option<&dyn QFunction>,
    effort: Effort,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> (Option<Found>, PolicyUse) {
    let Some(q) = policy else { return (None, PolicyUse::Missing) };
    let problem = Problem::of(instance.scenario.objective);
    let guide = Guide::new(instance, definition(problem), q);
    let before = budget.iterations();
    let mut kept = Kept::nothing(instance);
    // What it has built before it broke down is as good as any.
    let failure = guide.construct(effort, rng, budget, &mut kept).err();
    let feasible = kept.value.is_feasible();
    let found = feasible.then(|| Found {
        order: kept.order,
        solver: SolverName::Dqn,
        iterations: vec![("roll-outs".to_owned(), budget.iterations() - before)],
        claim: Claim::None,
    });
    let fared = match failure {
        Some(error) => PolicyUse::Failed(error),
        None if feasible => PolicyUse::Built,
        None => PolicyUse::NoTour,
    };
    (found, fared)
}
