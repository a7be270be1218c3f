//! A plan in its forms: the document, the picture, the map. None of them ever changes.

use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, Uri};
use axum::response::Response;

use super::RestState;
use super::immutable::{Form, known, not_modified, whole};
use super::lists::id;
use super::plans::{scenario_text, seen};
use super::problem::Problem;
use super::query::{Params, refusal};
use super::view::PlanEnvelope;
use crate::access::Caller;
use crate::domain::PlanId;
use crate::geojson::{self, Origin, OutOfReach};
use crate::planner::{self, Unreadable};
use crate::svg;

/// What is asked of a plan, by whom, and what the caller has of it.
pub(super) struct Asked {
    state: RestState,
    caller: Caller,
    id: String,
    headers: HeaderMap,
    uri: Uri,
}

/// The router knows one segment, the contract three addresses: the end of the name says which.
pub(super) async fn by_name(
    State(state): State<RestState>,
    caller: Caller,
    name: Result<Path<String>, PathRejection>,
    headers: HeaderMap,
    uri: Uri,
) -> Result<Response, Problem> {
    let name = name.map(|Path(name)| name).unwrap_or_default();
    let asked = |id: &str| Asked { state, caller, id: id.to_owned(), headers, uri };
    match name.rsplit_once('.') {
        Some((id, "svg")) => picture(asked(id)).await,
        Some((id, "geojson")) => map(asked(id)).await,
        _ => plan(asked(&name)).await,
    }
}

/// A plan with where it came from.
#[utoipa::path(get, path = "/v1/plans/{id}", tag = "plans", params(
    ("id" = uuid::Uuid, Path, description = "A plan's id"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "The plan. It never changes", body = PlanEnvelope,
     headers(("ETag" = String, description = "Strong, but weak where the answer is compressed"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn plan(asked: Asked) -> Result<Response, Problem> {
    Params::none(&asked.uri)?;
    let (plan_id, envelope) = envelope(&asked).await?;
    let tag = Form::Plan.tag(&plan_id.to_string());
    Ok(match known(&asked.headers, &tag) {
        Some(tag) => not_modified(Form::Plan, tag),
        None => whole(Form::Plan, &tag, envelope),
    })
}

/// The picture of a plan.
#[utoipa::path(get, path = "/v1/plans/{id}.svg", operation_id = "plan_picture", tag = "plans", params(
    ("id" = uuid::Uuid, Path, description = "A plan's id"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "One SVG document without script. It changes with the service's version only",
     body = String, content_type = "image/svg+xml",
     headers(("ETag" = String, description = "Strong, but weak where the answer is compressed"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn picture(asked: Asked) -> Result<Response, Problem> {
    Params::none(&asked.uri)?;
    let (plan_id, envelope) = envelope(&asked).await?;
    let tag = Form::Svg.tag(&plan_id.to_string());
    if let Some(tag) = known(&asked.headers, &tag) {
        return Ok(not_modified(Form::Svg, tag));
    }
    let picture = draw(&asked.state, plan_id, envelope, |envelope, scenario| {
        let (scenario, plan) = planner::stored(envelope, scenario)?;
        Ok(svg::picture(&scenario, &plan))
    });
    Ok(whole(Form::Svg, &tag, picture.await?))
}

/// The map of a plan, as GeoJSON (RFC 7946)
///
/// The field, the sensors, the tour and its ends, for a tool that shows or keeps maps. Positions of a network are
/// metres in a plane of its own. With `origin` they become longitude and latitude on WGS 84, x to the east and y to the
/// north of that point (azimuthal equidistant: `+proj=aeqd +lon_0=LON +lat_0=LAT`), as RFC 7946 wants them. Without it
/// they stay metres of the plane, which RFC 7946 leaves to those who have agreed on it: for tools with a plane of their
/// own, such as a simple or local reference system. A line across the 180th meridian is not cut there. Times are seconds
/// after the plan's `start`.
#[utoipa::path(get, path = "/v1/plans/{id}.geojson", operation_id = "plan_map", tag = "plans", params(
    ("id" = uuid::Uuid, Path, description = "A plan's id"),
    ("origin" = Option<String>, Query, example = "11.58,48.14",
     description = "`LON,LAT` in degrees: where on the earth the plane's origin lies"),
    ("If-None-Match" = Option<String>, Header, description = "Tags that the caller has"),
), responses(
    (status = 200, description = "A feature collection. Each feature's property `kind` says what it is: `field`, `tour`, \
        `sensor` (with its `role`: stop, unserved or idle), `start`, `end`. It changes with the service's version only",
     body = serde_json::Value, content_type = "application/geo+json",
     headers(("ETag" = String, description = "Strong, but weak where the answer is compressed"))),
    (status = 304, description = "The caller has it"),
    (status = 404, description = "There is no such plan", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn map(asked: Asked) -> Result<Response, Problem> {
    let mut params = Params::of(&asked.uri)?;
    let origin = params.one::<Origin>("origin");
    params.finish()?;
    let (plan_id, envelope) = envelope(&asked).await?;
    // Of this address, which holds the origin: it needs no place in the tag.
    let tag = Form::GeoJson.tag(&plan_id.to_string());
    if let Some(tag) = known(&asked.headers, &tag) {
        return Ok(not_modified(Form::GeoJson, tag));
    }
    let drawn = draw(&asked.state, plan_id, envelope, move |envelope, scenario| {
        let (scenario, plan) = planner::stored(envelope, scenario)?;
        Ok(geojson::map(&scenario, &plan, origin.as_ref()))
    });
    let map = drawn.await?.map_err(|error: OutOfReach| refusal("origin", error.to_string()))?;
    Ok(whole(Form::GeoJson, &tag, map))
}

async fn envelope(asked: &Asked) -> Result<(PlanId, Vec<u8>), Problem> {
    let plan_id: PlanId = id("plan", &asked.id)?;
    seen(&asked.state, &asked.caller, plan_id).await?;
    let envelope = asked.state.reads.plan_envelope(plan_id).await?;
    Ok((plan_id, envelope.ok_or_else(|| Problem::not_found("plan", plan_id))?))
}

/// Draws on a thread that may take its time, only so many at once. The permit goes with the drawing:
/// a caller who has gone frees no place before it is done.
async fn draw<T: Send + 'static>(
    state: &RestState,
    id: PlanId,
    envelope: Vec<u8>,
    draw: impl FnOnce(&[u8], &[u8]) -> Result<T, Unreadable> + Send + 'static,
) -> Result<T, Problem> {
    let permit = state.pictures.clone().acquire_owned().await;
    let permit = permit.map_err(|error| Problem::internal(&error))?;
    let scenario = scenario_text(state, id).await?;
    let drawing = tokio::task::spawn_blocking(move || {
        let _permit = permit;
        draw(&envelope, &scenario)
    });
    let drawn = drawing.await.map_err(|error| Problem::internal(&error))?;
    drawn.map_err(|error| Problem::internal(&format!("plan {id}: {error}")))
}
