//! What a plan says of itself: its status and its bound.

use crate::plan::{Plan, Status};
use crate::scenario::{Objective, Scenario};

use super::broken::Findings;
use super::close::{Verdict, equal, keeps};
use super::limits::Limits;

/// Reports a status that the tour does not bear out. `broken` says whether the tour breaks one of
/// the constraints that are listed as violations.
pub(super) fn compare(plan: &Plan, limits: &Limits, broken: Verdict, findings: &mut Findings) {
    let status = plan.status;
    if status.is_feasible() {
        limits.report(findings);
        if broken == Verdict::Broken {
            findings.add("status", &status, "the tour breaks a constraint: see violations");
        }
        if !plan.violations.is_empty() {
            let rule = format!("must be empty where the status is {}", status.name());
            findings.add("violations", &plan.violations, rule);
        }
    } else {
        // An empty trip over its budgets is all that a charger can do; violations say so.
        if !limits.empty_trip {
            limits.report(findings);
        }
        if broken == Verdict::Kept {
            findings.add("status", &status, "the tour breaks no constraint: it is feasible");
        }
        if plan.violations.is_empty() {
            let rule = format!("must name what is broken where the status is {}", status.name());
            findings.add("violations", &plan.violations, rule);
        }
    }
}

/// Reports a bound that contradicts the status or the objective.
pub(super) fn compare_bound(scenario: &Scenario, plan: &Plan, findings: &mut Findings) {
    let Some(bound) = plan.bound else {
        if plan.status == Status::Optimal {
            findings.add("bound", &plan.bound, "must prove the objective where status is optimal");
        }
        return;
    };
    if !bound.is_finite() {
        findings.add("bound", &bound, "must be a number");
        return;
    }
    let count = scenario.objective == Objective::MaxCount;
    if count && bound.fract() != 0.0 {
        findings.add("bound", &bound, "must be a whole number for max_count");
    }
    let agrees = match scenario.objective {
        Objective::MinDistance => keeps(bound, plan.objective),
        Objective::MaxReward | Objective::MaxCount => keeps(-bound, -plan.objective),
    };
    match plan.status {
        Status::Infeasible => findings.add("bound", &bound, "must be null where infeasible"),
        Status::Optimal if !equal(bound, plan.objective) => {
            let rule = format!("must equal the objective, {}: optimal", plan.objective);
            findings.add("bound", &bound, rule);
        }
        Status::Feasible if !agrees => {
            let rule = format!("the tour is better, with an objective of {}", plan.objective);
            findings.add("bound", &bound, rule);
        }
        _ => {}
    }
}
