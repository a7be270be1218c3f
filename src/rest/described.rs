//! What the guard adds to the OpenAPI document: the two ways to bring a token, and the refusals that every
//! route may give.

use utoipa::Modify;
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{Content, OpenApi, Ref, RefOr, Response};

use super::openapi::operations;
use super::problem::MEDIA_TYPE;
use crate::access::table::{self, Who};

/// Describes the guard.
pub(super) struct Guarded;

impl Modify for Guarded {
    fn modify(&self, api: &mut OpenApi) {
        let components = api.components.get_or_insert_default();
        for (name, scheme) in
            [("token", HttpAuthScheme::Bearer), ("password", HttpAuthScheme::Basic)]
        {
            components.add_security_scheme(name, SecurityScheme::Http(Http::new(scheme)));
        }
        for (path, item) in &mut api.paths.paths {
            let is_open = table::rest(path) == Some(Who::Anybody);
            operations(item).for_each(|operation| describe(operation, is_open));
        }
    }
}

fn describe(operation: &mut Operation, is_open: bool) {
    let mut add = |status: &str, description: &str| {
        let response = RefOr::T(problem(description));
        operation.responses.responses.entry(status.to_owned()).or_insert(response);
    };
    add("421", "The caller speaks to another host; see `rest.hosts`");
    if is_open {
        return;
    }
    add("401", "A token is needed, and none or no good one came");
    add("403", "The token's role may not, or it is not for all networks");
    let none: [&str; 0] = [];
    // The first: as long as the service has no token, none is needed.
    let ways = [SecurityRequirement::default()].into_iter();
    let ways = ways.chain(["token", "password"].map(|way| SecurityRequirement::new(way, none)));
    operation.security = Some(ways.collect());
}

/// A refusal, as it is described.
pub(super) fn problem(description: &str) -> Response {
    let content = Content::new(Some(Ref::from_schema_name("Problem")));
    Response::builder().description(description).content(MEDIA_TYPE, content).build()
}

#[cfg(test)]
mod tests {
    use crate::rest::openapi::api;

    #[test]
    fn every_route_but_those_of_health_says_that_it_needs_a_token() {
        let api = serde_json::to_value(api()).unwrap();
        for (path, item) in api["paths"].as_object().unwrap() {
            let open = ["/healthz", "/readyz"].contains(&path.as_str());
            let (get, described) = (&item["get"], |status: &str| {
                item["get"]["responses"][status]["content"]["application/problem+json"].is_object()
            });
            assert_eq!(get["security"].is_array(), !open, "{path}");
            assert_eq!(described("401") && described("403"), !open, "{path}");
            assert!(described("421"), "{path}");
        }
        let schemes = &api["components"]["securitySchemes"];
        assert_eq!(
            (&schemes["token"]["scheme"], &schemes["password"]["scheme"]),
            (&"bearer".into(), &"basic".into())
        );
    }
}
