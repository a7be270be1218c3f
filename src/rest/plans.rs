//! Plans: the list, and the scenario of each, which never changes.

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, Uri};
use axum::response::Response;
use voltour_solver::solvers::SolverName;

use super::RestState;
use super::immutable::{Form, known, not_modified, whole};
use super::lists::id;
use super::problem::Problem;
use super::query::Params;
use super::view::{PlanPage, PlanStatus};
use crate::access::Caller;
use crate::domain::PlanId;
use crate::store::PlanFilter;

/// Plans, newest first.
#[utoipa::path(get, path = "/v1/plans", tag = "plans", params(
    ("network" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this network"),
    ("charger" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this charger"),
    ("status" = Option<PlanStatus>, Query, description = "Of this status"),
    ("solver" = Option<String>, Query, description = "Whose tour this solver found"),
    ("from" = Option<jiff::Timestamp>, Query, description = "Made at or after it"),
    ("until" = Option<jiff::Timestamp>, Query, description = "Made before it"),
    ("limit" = Option<u32>, Query, minimum = 1, maximum = 500,
     description = "1 to 500; 50 where it is left out"),
    ("cursor" = Option<String>, Query, max_length = 128,
     description = "`next_cursor` of the page before; opaque"),
), responses(
    (status = 200, description = "A page", body = PlanPage),
    (status = 400, description = "Bad parameters", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn plans(
    State(state): State<RestState>,
    caller: Caller,
    uri: Uri,
) -> Result<Json<PlanPage>, Problem> {
    let mut params = Params::of(&uri)?;
    let filter = filter(&caller, &mut params);
    let page = params.page::<PlanId>();
    params.finish()?;
    Ok(Json(state.reads.plans(&filter, &page).await?.into()))
}

/// Which plans are asked for, in a list and in an export.
pub(super) fn filter(caller: &Caller, params: &mut Params) -> PlanFilter {
    PlanFilter {
        within: caller.networks().clone(),
        network_id: params.one("network"),
        charger_id: params.one("charger"),
        status: params.named::<PlanStatus>("status").map(|status| status.name().to_owned()),
        solver: params.one::<SolverName>("solver").map(|solver| solver.name().to_owned()),
        from: params.time("from"),
        until: params.time("until"),
    }
}

/// The scenario that a plan answers.
#[utoipa::path(get, path = "/v1/plans/{id}/scenario", tag = "plans", params(
    ("id" = uuid::Uuid, Path, description = "A plan's id"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "A document `voltour/scenario/1`. It never changes",
     body = serde_json::Value, headers(("ETag" = String, description = "A strong tag"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn scenario(
    State(state): State<RestState>,
    caller: Caller,
    name: Result<Path<String>, PathRejection>,
    headers: HeaderMap,
    uri: Uri,
) -> Result<Response, Problem> {
    Params::none(&uri)?;
    let plan_id: PlanId = id("plan", &name.map(|Path(name)| name).unwrap_or_default())?;
    seen(&state, &caller, plan_id).await?;
    let text = scenario_text(&state, plan_id).await?;
    let tag = Form::Scenario.tag(&plan_id.to_string());
    Ok(match known(&headers, &tag) {
        Some(tag) => not_modified(Form::Scenario, tag),
        None => whole(Form::Scenario, &tag, text),
    })
}

/// Refuses a plan of a network that the caller does not know of like one that is not there.
pub(super) async fn seen(state: &RestState, caller: &Caller, id: PlanId) -> Result<(), Problem> {
    if !caller.is_restricted() {
        return Ok(());
    }
    let network = state.reads.plan_network(id).await?;
    let seen = network.is_some_and(|network| caller.sees(&network));
    if seen { Ok(()) } else { Err(Problem::not_found("plan", id)) }
}

pub(super) async fn scenario_text(state: &RestState, id: PlanId) -> Result<Vec<u8>, Problem> {
    let text = state.reads.plan_scenario(id).await?;
    text.ok_or_else(|| Problem::not_found("plan", id))
}
