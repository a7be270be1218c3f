//! Plans: the list, and of each plan its document, its scenario and its picture, which never change.

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, Uri};
use axum::response::Response;
use voltour_solver::solvers::SolverName;

use super::RestState;
use super::immutable::{Form, is_known, not_modified, whole};
use super::lists::id;
use super::problem::Problem;
use super::query::Params;
use super::view::{PlanEnvelope, PlanPage, PlanStatus};
use crate::access::Caller;
use crate::domain::PlanId;
use crate::planner::{self, Unreadable};
use crate::store::PlanFilter;
use crate::svg;

/// Plans, newest first.
#[utoipa::path(get, path = "/v1/plans", tag = "plans", params(
    ("network" = Option<String>, Query, description = "Of this network"),
    ("charger" = Option<String>, Query, description = "Of this charger"),
    ("status" = Option<PlanStatus>, Query, description = "Of this status"),
    ("solver" = Option<String>, Query, description = "Whose tour this solver found"),
    ("from" = Option<jiff::Timestamp>, Query, description = "Made at or after it"),
    ("until" = Option<jiff::Timestamp>, Query, description = "Made before it"),
    ("limit" = Option<u32>, Query, description = "1 to 500; 50 where it is left out"),
    ("cursor" = Option<String>, Query, description = "`next_cursor` of the page before"),
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
    let filter = PlanFilter {
        within: caller.networks().clone(),
        network_id: params.one("network"),
        charger_id: params.one("charger"),
        status: params.named::<PlanStatus>("status").map(|status| status.name().to_owned()),
        solver: params.one::<SolverName>("solver").map(|solver| solver.name().to_owned()),
        from: params.time("from"),
        until: params.time("until"),
    };
    let page = params.page::<PlanId>();
    params.finish()?;
    Ok(Json(state.reads.plans(&filter, &page).await?.into()))
}

/// A plan with where it came from; with `.svg` after the id, its picture.
#[utoipa::path(get, path = "/v1/plans/{id}", tag = "plans", params(
    ("id" = String, Path, description = "A plan's id; `{id}.svg` is its picture"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "The plan, or its picture. It never changes", content(
        (PlanEnvelope = "application/json"),
        (String = "image/svg+xml"),
    ), headers(("ETag" = String, description = "A strong tag"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn plan(
    State(state): State<RestState>,
    caller: Caller,
    name: Result<Path<String>, PathRejection>,
    headers: HeaderMap,
    uri: Uri,
) -> Result<Response, Problem> {
    Params::none(&uri)?;
    let name = name.map(|Path(name)| name).unwrap_or_default();
    let (text, form) = match name.strip_suffix(".svg") {
        Some(id) => (id, Form::Svg),
        None => (name.as_str(), Form::Plan),
    };
    let plan_id: PlanId = id("plan", text)?;
    known(&state, &caller, plan_id).await?;
    let envelope = state.reads.plan_envelope(plan_id).await?;
    let envelope = envelope.ok_or_else(|| Problem::not_found("plan", plan_id))?;
    let tag = form.tag(&plan_id.to_string());
    if is_known(&headers, &tag) {
        return Ok(not_modified(form, &tag));
    }
    Ok(match form {
        Form::Svg => whole(form, &tag, picture(&state, plan_id, envelope).await?),
        _ => whole(form, &tag, envelope),
    })
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
    known(&state, &caller, plan_id).await?;
    let text = scenario_text(&state, plan_id).await?;
    let tag = Form::Scenario.tag(&plan_id.to_string());
    Ok(match is_known(&headers, &tag) {
        true => not_modified(Form::Scenario, &tag),
        false => whole(Form::Scenario, &tag, text),
    })
}

/// Refuses a plan of a network that the caller does not know of like one that is not there.
pub(super) async fn known(state: &RestState, caller: &Caller, id: PlanId) -> Result<(), Problem> {
    if !caller.is_restricted() {
        return Ok(());
    }
    let network = state.reads.plan_network(id).await?;
    let seen = network.is_some_and(|network| caller.sees(&network));
    if seen { Ok(()) } else { Err(Problem::not_found("plan", id)) }
}

async fn scenario_text(state: &RestState, id: PlanId) -> Result<Vec<u8>, Problem> {
    let text = state.reads.plan_scenario(id).await?;
    text.ok_or_else(|| Problem::not_found("plan", id))
}

/// Draws on a thread that may take its time, only so many at once. The permit goes with the drawing:
/// a caller who has gone frees no place before it is done.
async fn picture(state: &RestState, id: PlanId, envelope: Vec<u8>) -> Result<String, Problem> {
    let permit = state.pictures.clone().acquire_owned().await;
    let permit = permit.map_err(|error| Problem::internal(&error))?;
    let scenario = scenario_text(state, id).await?;
    let drawing = tokio::task::spawn_blocking(move || {
        let _permit = permit;
        draw(&envelope, &scenario)
    });
    let drawn = drawing.await.map_err(|error| Problem::internal(&error))?;
    drawn.map_err(|error| Problem::internal(&format!("picture of plan {id}: {error}")))
}

fn draw(envelope: &[u8], scenario: &[u8]) -> Result<String, Unreadable> {
    let (scenario, plan) = planner::stored(envelope, scenario)?;
    Ok(svg::picture(&scenario, &plan))
}

#[cfg(test)]
mod tests {
    use super::draw;

    const SCENARIO: &[u8] = br#"{"format": "voltour/scenario/1", "objective": "min_distance",
        "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20},
        "sensors": [], "requests": []}"#;

    #[test]
    fn an_envelope_gives_a_picture() {
        let plan = r#"{"format": "voltour/plan/1", "scenario": null, "status": "optimal",
            "solver": "exact", "objective": 0, "bound": 0, "distance_m": 0, "travel_j": 0,
            "charge_j": 0, "finish_s": 0, "stops": [], "unserved": [], "violations": [],
            "warnings": [], "elapsed_s": 0}"#;
        let envelope = format!(r#"{{"plan": {plan}, "provenance": {{"seed": 1}}}}"#);
        assert!(draw(envelope.as_bytes(), SCENARIO).unwrap().starts_with("<svg"));
    }
}
