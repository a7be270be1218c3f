//! [`PolicyPart`]: what part the policy had in a plan, for the provenance and for whoever counts.

use voltour_solver::solvers::{PolicyUse, SolverName};

use crate::domain::PolicyUsed;
use crate::policy::{Fallback, ModelError, Policy, Winning};

/// What part the policy had in a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolicyPart {
    /// The policy that was asked for values.
    pub used: Option<PolicyUsed>,
    /// Why the plan was made without it, where it was, and that in words.
    pub fallback: Option<(Fallback, String)>,
    /// Whose tour was the best, where the policy built one.
    pub winning: Option<Winning>,
}

/// Whether a solver asks a policy.
pub(super) fn uses_policy(solver: SolverName) -> bool {
    matches!(solver, SolverName::Auto | SolverName::Dqn)
}

impl PolicyPart {
    /// Of a plan that this solver was asked for, when the policy fared so, and whose tour was found by `winner`.
    pub(super) fn of(
        asked: SolverName,
        policy: Result<&Policy, &ModelError>,
        tried: &PolicyUse,
        winner: &str,
    ) -> Self {
        let policy = match policy {
            _ if !uses_policy(asked) => return Self::default(),
            Err(error) => {
                let fallback = Some((Fallback::from(&error.fault), error.to_string()));
                return Self { fallback, ..Self::default() };
            }
            Ok(policy) => policy,
        };
        let used = Some(used(policy));
        let file = &policy.about.source;
        match tried {
            PolicyUse::Unused | PolicyUse::Missing => Self::default(),
            PolicyUse::Built => Self { used, winning: Some(Winning::of(winner)), fallback: None },
            PolicyUse::NoTour => {
                let why = format!("{file}: it built no feasible tour");
                Self { used, fallback: Some((Fallback::NoTour, why)), winning: None }
            }
            PolicyUse::Failed(error) => {
                let why = format!("{file}: {error}");
                Self { used, fallback: Some((Fallback::from(error), why)), winning: None }
            }
        }
    }

    /// For the provenance: why the plan was made without the policy, and why contenders were refused.
    pub(super) fn reason(&self, refused: &[String]) -> Option<String> {
        let policy = self.fallback.as_ref().map(|(reason, why)| format!("policy: {reason}: {why}"));
        let reasons: Vec<String> = policy.into_iter().chain(refused.iter().cloned()).collect();
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }
}

fn used(policy: &Policy) -> PolicyUsed {
    let about = &policy.about;
    PolicyUsed {
        name: about.name.clone(),
        digest: about.digest.clone(),
        problem: about.problem.name().to_owned(),
        feature_version: about.feature_version,
    }
}
