//! Plans.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;
use voltour_solver::plan::Status;

use crate::rest::query::Named;
use crate::store;

/// What is known of a plan's tour
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(in crate::rest) enum PlanStatus {
    Optimal,
    Feasible,
    BestEffort,
    Infeasible,
}

impl PlanStatus {
    /// As the plan document spells it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Feasible => "feasible",
            Self::BestEffort => "best_effort",
            Self::Infeasible => "infeasible",
        }
    }
}

impl From<Status> for PlanStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Optimal => Self::Optimal,
            Status::Feasible => Self::Feasible,
            Status::BestEffort => Self::BestEffort,
            Status::Infeasible => Self::Infeasible,
        }
    }
}

impl Named for PlanStatus {
    const NAMES: &'static str = "optimal, feasible, best_effort, infeasible";
}

/// A plan in a list
#[derive(Debug, Serialize, ToSchema)]
pub(in crate::rest) struct PlanSummary {
    id: Uuid,
    departure_id: Uuid,
    /// Among the plans of its departure, from 1
    revision: u32,
    network_id: String,
    charger_id: String,
    status: PlanStatus,
    /// The solver whose tour it is
    solver: String,
    objective: f64,
    /// Proven bound on the objective
    bound: Option<f64>,
    /// How far the tour may be from the best: |objective - bound| / |bound|
    gap: Option<f64>,
    distance_m: f64,
    stops: u32,
    unserved: u32,
    /// Second 0
    start: Timestamp,
    finish: Timestamp,
    created_at: Timestamp,
}

impl From<store::PlanSummary> for PlanSummary {
    fn from(plan: store::PlanSummary) -> Self {
        Self {
            id: plan.id.0,
            departure_id: plan.departure_id.0,
            revision: plan.revision,
            network_id: plan.network_id.into(),
            charger_id: plan.charger_id.into(),
            status: plan.status.into(),
            solver: plan.solver,
            objective: plan.objective,
            bound: plan.bound,
            gap: plan.gap,
            distance_m: plan.distance_m,
            stops: plan.stops,
            unserved: plan.unserved,
            start: plan.start,
            finish: plan.finish,
            created_at: plan.created_at,
        }
    }
}

/// A plan with where it came from, exactly as it was stored
#[derive(ToSchema)]
#[allow(dead_code, reason = "only its schema is used: what is stored goes out as it is")]
pub(in crate::rest) struct PlanEnvelope {
    /// A document `voltour/plan/1`
    #[schema(value_type = Object)]
    plan: (),
    /// Solver asked for, contenders, winner, `policy` (name, SHA-256 `digest`, `problem`, `feature_version` of the trained policy that was asked; null where none was), `fallback_reason` (why the plan was made without the policy, `policy: REASON: ...` with one of no_model, damaged, wrong_version, wrong_problem, wrong_shape, not_finite, too_slow, no_tour, failed, and why contenders were refused; null where neither), `gap` (|objective - bound| / |bound|, null without a bound), seed, iterations, versions, batch, what the check said
    #[schema(value_type = Object)]
    provenance: (),
}
