//! The OpenAPI document, made from the handlers and from the types that they answer with.

use std::sync::LazyLock;

use axum::body::Body;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderValue, Uri};
use axum::response::Response;
use utoipa::OpenApi;

use super::described::Guarded;
use super::problem::Problem;
use super::query::Params;
use super::view::PlanStatus;
use super::{explanations, health, lists, metrics, plans};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "voltour",
        description = "What the scheduling service has stored, to be read. Lists are \
            `{items, next_cursor}`; times are RFC 3339; errors are problem documents (RFC 9457); \
            unknown query parameters are refused. Everything that changes something is gRPC."
    ),
    paths(
        lists::networks,
        lists::network,
        lists::requests,
        lists::request,
        lists::departures,
        lists::departure,
        plans::plans,
        plans::plan,
        plans::scenario,
        explanations::explanation,
        metrics::metrics,
        health::healthz,
        health::readyz,
    ),
    components(schemas(PlanStatus)),
    modifiers(&Guarded)
)]
struct Api;

static DOCUMENT: LazyLock<Result<String, serde_json::Error>> =
    LazyLock::new(|| Api::openapi().to_pretty_json());

/// The document.
pub(super) async fn document(uri: Uri) -> Result<Response, Problem> {
    Params::none(&uri)?;
    let text = DOCUMENT.as_deref().map_err(|error| Problem::internal(&error))?;
    let mut response = Response::new(Body::from(text));
    let json = HeaderValue::from_static("application/json");
    response.headers_mut().insert(CONTENT_TYPE, json);
    Ok(response)
}

#[cfg(test)]
pub(super) fn api() -> utoipa::openapi::OpenApi {
    Api::openapi()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reference_leads_somewhere() {
        let text = Api::openapi().to_json().unwrap();
        let document: serde_json::Value = serde_json::from_str(&text).unwrap();
        for rest in text.split("\"#/components/schemas/").skip(1) {
            let name = rest.split('"').next().unwrap();
            assert!(document["components"]["schemas"].get(name).is_some(), "{name}");
        }
    }

    #[test]
    fn every_route_is_described() {
        let api = Api::openapi();
        let mut paths: Vec<_> = api.paths.paths.keys().map(String::as_str).collect();
        paths.sort_unstable();
        assert_eq!(
            paths,
            [
                "/healthz",
                "/metrics",
                "/readyz",
                "/v1/departures",
                "/v1/departures/{id}",
                "/v1/networks",
                "/v1/networks/{id}",
                "/v1/plans",
                "/v1/plans/{id}",
                "/v1/plans/{id}/explanation",
                "/v1/plans/{id}/scenario",
                "/v1/requests",
                "/v1/requests/{id}",
            ]
        );
    }
}
