//! The policy's construction alone: roll-outs that a trained Q-function guides, and re-insertion of the
//! stops they choose. No local search.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::entry::{Claim, Found, PolicyUse};
use super::{Budget, SolverName};
use crate::framework::definition;
use crate::instance::Instance;
use crate::policy::guided::{Effort, Guide, Kept};
use crate::policy::{Problem, QFunction};

/// The best tour of the construction, and how the policy fared; without a feasible tour nothing is found, nor
/// from a policy that breaks down.
pub fn dqn(
    instance: &Instance<'_>,
    policy: Option<&dyn QFunction>,
    effort: Effort,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> (Option<Found>, PolicyUse) {
    // Its own random numbers, so that what comes after it does not hang on whether there was a policy.
    let mut rng = Pcg64Mcg::seed_from_u64(rng.next_u64());
    let Some(q) = policy else { return (None, PolicyUse::Missing) };
    let problem = Problem::of(instance.scenario.objective);
    let guide = Guide::new(instance, definition(problem), q);
    let before = budget.iterations();
    let mut kept = Kept::nothing(instance);
    if let Err(error) = guide.construct(effort, &mut rng, budget, &mut kept) {
        // As if it had not been there: what it built up to then hangs on when it broke down, so that nobody
        // could make the plan again.
        budget.take_back(before);
        return (None, PolicyUse::Failed(error));
    }
    let feasible = kept.value.is_feasible();
    let found = feasible.then(|| Found {
        order: kept.order,
        solver: SolverName::Dqn,
        iterations: vec![("roll-outs".to_owned(), budget.iterations() - before)],
        claim: Claim::None,
    });
    (found, if feasible { PolicyUse::Built } else { PolicyUse::NoTour })
}
