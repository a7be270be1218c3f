//! The routes.

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::middleware::from_fn_with_state;
use axum::routing::get;

use super::count::count;
use super::dress::dress;
use super::guard::{Guard, guard};
use super::routes::Routes;
use super::{
    RestState, docs, explanations, export, health, lists, log_filter, metrics, openapi, plan_forms,
    plans,
};

/// Every route of the REST edge, with its layers.
pub fn router(state: RestState, behind: Guard) -> Router {
    let ((routes, _), calls) = (routes().finish(), state.metrics.calls.clone());
    let routes = routes.with_state(state).layer(from_fn_with_state(behind, guard));
    dress(routes).layer(from_fn_with_state(calls, count))
}

fn routes() -> Routes<RestState> {
    Routes::new()
        .route("/v1/networks", get(lists::networks))
        .route("/v1/networks/{id}", get(lists::network))
        .route("/v1/requests", get(lists::requests))
        .route("/v1/requests/{id}", get(lists::request))
        .route("/v1/departures", get(lists::departures))
        .route("/v1/departures/{id}", get(lists::departure))
        .route("/v1/plans", get(plans::plans))
        .route("/v1/plans.csv", get(export::plans))
        // One segment holds no parameter with a suffix: the handler tells `{id}`, `{id}.svg` and `{id}.geojson`.
        .route("/v1/plans/{id}", get(plan_forms::by_name))
        .route("/v1/plans/{id}/scenario", get(plans::scenario))
        .route("/v1/plans/{id}/explanation", get(explanations::explanation))
        .route(
            "/v1/log-filter",
            get(log_filter::show)
                .put(log_filter::set)
                .layer(DefaultBodyLimit::max(log_filter::BODY_BYTES)),
        )
        .route("/openapi.json", get(openapi::document))
        .route("/docs", get(docs::to_page))
        .route("/docs/", get(docs::page))
        .route("/docs/{file}", get(docs::file))
        .route("/metrics", get(metrics::metrics))
        .route("/healthz", get(health::healthz))
        .route("/readyz", get(health::readyz))
}

#[cfg(test)]
mod tests {
    use super::routes;
    use crate::access::table;

    #[test]
    fn every_route_has_an_entry_in_the_access_table_and_every_entry_a_route() {
        let (_, paths) = routes().finish();
        for path in &paths {
            assert!(table::rest(path).is_some(), "{path} has no entry: nobody can call it");
        }
        for (entry, _) in table::REST {
            assert!(paths.contains(entry), "{entry} is no route");
        }
        assert_eq!(paths.len(), table::REST.len());
    }
}
