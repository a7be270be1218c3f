//! Why a plan is as it is: the document, or the same in an operator's words. It comes after the plan, and
//! never changes once it is there.

use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, Uri};
use axum::response::Response;
use serde::Deserialize;
use voltour_solver::explain::Explanation;

use super::RestState;
use super::accept::prefers_text;
use super::immutable::{Form, known, not_modified, whole};
use super::lists::id;
use super::plans::seen;
use super::problem::Problem;
use super::query::{Named, Params};
use crate::access::Caller;
use crate::domain::PlanId;
use crate::store::Explained;

/// How an explanation is asked for.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Shown {
    Json,
    Text,
}

impl Named for Shown {
    const NAMES: &'static str = "json, text";
}

/// Why a plan is as it is: constraints that contradict each other, why each request is or is not served, and
/// what would make the tour better. It is made after the plan and stored with it.
#[utoipa::path(get, path = "/v1/plans/{id}/explanation", tag = "plans", params(
    ("id" = uuid::Uuid, Path, description = "A plan's id"),
    ("format" = Option<String>, Query, pattern = "^(json|text)$",
     description = "`json` or `text`; as `Accept` says where it is left out, else JSON"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "A document `voltour/explanation/1`, or its text. It never changes", content(
        (serde_json::Value = "application/json"),
        (String = "text/plain"),
    ), headers(("ETag" = String, description = "A strong tag"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan; or, with the type `tag:voltour,2026:not-explained-yet` or \
        `tag:voltour,2026:not-explained`, it is not explained yet, or will not be", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn explanation(
    State(state): State<RestState>,
    caller: Caller,
    name: Result<Path<String>, PathRejection>,
    headers: HeaderMap,
    uri: Uri,
) -> Result<Response, Problem> {
    let mut params = Params::of(&uri)?;
    let shown = params.named::<Shown>("format");
    params.finish()?;
    let plan_id: PlanId = id("plan", &name.map(|Path(name)| name).unwrap_or_default())?;
    seen(&state, &caller, plan_id).await?;
    let stored = state.reads.explanation(plan_id).await?;
    let document = match stored.ok_or_else(|| Problem::not_found("plan", plan_id))? {
        Explained::Document(document) => document,
        Explained::NotYet => return Err(not_yet(plan_id)),
        Explained::GivenUp => return Err(given_up(plan_id)),
    };
    let form = match shown {
        Some(Shown::Text) => Form::ExplanationText,
        None if prefers_text(&headers) => Form::ExplanationText,
        _ => Form::Explanation,
    };
    let tag = form.tag(&plan_id.to_string());
    if let Some(tag) = known(&headers, &tag) {
        return Ok(not_modified(form, tag));
    }
    Ok(match form {
        Form::ExplanationText => whole(form, &tag, text(plan_id, &document)?),
        _ => whole(form, &tag, document),
    })
}

fn text(id: PlanId, document: &[u8]) -> Result<String, Problem> {
    let explanation: Result<Explanation, _> = serde_json::from_slice(document);
    let failed = |error| Problem::internal(&format!("explanation of plan {id}: {error}"));
    Ok(explanation.map_err(failed)?.to_string())
}

fn not_yet(id: PlanId) -> Problem {
    Problem::missing("tag:voltour,2026:not-explained-yet", "Not explained yet").detail(format!(
        "plan {id} is not explained yet; the newest plans are, one after the other, unless \
         planning.explanation_budget is 0"
    ))
}

fn given_up(id: PlanId) -> Problem {
    Problem::missing("tag:voltour,2026:not-explained", "Not explained").detail(format!(
        "plan {id} could not be explained, and is not tried again: the service's log says why"
    ))
}
