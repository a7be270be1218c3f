//! The OpenAPI document, made from the handlers and from the types that they answer with.

use std::sync::LazyLock;

use axum::body::Body;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderValue, Uri};
use axum::response::Response;
use utoipa::openapi::PathItem;
use utoipa::openapi::path::Operation;
use utoipa::{Modify, OpenApi, openapi};

use super::described::{Guarded, problem};
use super::problem::Problem;
use super::query::Params;
use super::view::PlanStatus;
use super::{explanations, export, health, lists, log_filter, metrics, plan_forms, plans};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "voltour",
        description = "What the scheduling service has stored, to be read. Lists are \
            `{items, next_cursor}`; times are RFC 3339; errors are problem documents (RFC 9457); \
            unknown query parameters are refused. Everything that changes something of it is gRPC."
    ),
    paths(
        lists::networks,
        lists::network,
        lists::requests,
        lists::request,
        lists::departures,
        lists::departure,
        plans::plans,
        export::plans,
        plan_forms::plan,
        plan_forms::picture,
        plan_forms::map,
        plans::scenario,
        explanations::explanation,
        log_filter::show,
        log_filter::set,
        metrics::metrics,
        health::healthz,
        health::readyz,
    ),
    components(schemas(PlanStatus)),
    modifiers(&Guarded, &Refusals)
)]
struct Api;

/// What any operation may answer, whatever it is.
const REFUSALS: [(&str, &str); 6] = [
    ("400", "Bad parameters"),
    ("406", "Neither gzip nor the plain answer is acceptable"),
    ("429", "Too many calls at once; try again"),
    ("500", "The service failed; its log says why"),
    ("503", "Not now"),
    ("504", "It took too long"),
];

/// Writes [`REFUSALS`] to every operation, beside what it says itself.
struct Refusals;

impl Modify for Refusals {
    fn modify(&self, api: &mut openapi::OpenApi) {
        let operations = api.paths.paths.values_mut().flat_map(operations);
        for operation in operations {
            for (status, text) in REFUSALS {
                let responses = &mut operation.responses.responses;
                responses.entry(status.to_owned()).or_insert_with(|| problem(text).into());
            }
        }
    }
}

/// What is described of a path.
pub(super) fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut Operation> {
    [&mut item.get, &mut item.put].into_iter().filter_map(|operation| operation.as_mut())
}

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

    /// `just openapi` writes the file again.
    #[test]
    fn the_checked_in_document_is_this_one() {
        let text = Api::openapi().to_pretty_json().unwrap() + "\n";
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/openapi.json");
        if std::env::var_os("VOLTOUR_WRITE_OPENAPI").is_some() {
            std::fs::write(file, &text).unwrap();
        }
        let checked_in = std::fs::read_to_string(file).unwrap_or_default();
        let differs = text.lines().zip(checked_in.lines()).find(|(made, read)| made != read);
        assert_eq!(
            differs, None,
            "made from the handlers, docs/openapi.json; `just openapi` writes it"
        );
        assert_eq!(text.lines().count(), checked_in.lines().count(), "`just openapi` writes it");
    }

    #[test]
    fn every_operation_has_a_name_of_its_own_and_tells_its_refusals() {
        let mut names = std::collections::HashSet::new();
        for (path, mut item) in Api::openapi().paths.paths {
            assert!(operations(&mut item).count() > 0, "{path}");
            for operation in operations(&mut item) {
                assert!(names.insert(operation.operation_id.clone()), "{path}");
                for (status, _) in REFUSALS {
                    assert!(operation.responses.responses.contains_key(status), "{path} {status}");
                }
            }
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
                "/v1/log-filter",
                "/v1/networks",
                "/v1/networks/{id}",
                "/v1/plans",
                "/v1/plans.csv",
                "/v1/plans/{id}",
                "/v1/plans/{id}.geojson",
                "/v1/plans/{id}.svg",
                "/v1/plans/{id}/explanation",
                "/v1/plans/{id}/scenario",
                "/v1/requests",
                "/v1/requests/{id}",
            ]
        );
    }
}
