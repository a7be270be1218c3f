//! The routes.

use axum::Router;
use axum::routing::get;

use super::dress::dress;
use super::{
    RestState, docs, explanations, export, health, lists, metrics, openapi, plan_forms, plans,
};

/// Every route of the REST edge, with its layers.
pub fn router(state: RestState) -> Router {
    let routes = Router::new()
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
        .route("/openapi.json", get(openapi::document))
        .route("/docs", get(docs::to_page))
        .route("/docs/", get(docs::page))
        .route("/docs/{file}", get(docs::file))
        .route("/metrics", get(metrics::metrics))
        .route("/healthz", get(health::healthz))
        .route("/readyz", get(health::readyz))
        .with_state(state);
    dress(routes)
}
