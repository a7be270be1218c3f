//! What the service counts, for a monitor.

use std::time::Duration;

use axum::extract::State;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderValue, Uri};
use axum::response::{IntoResponse, Response};

use super::RestState;
use super::problem::Problem;
use super::query::Params;

/// A monitor waits for ten seconds, as a rule.
const PATIENCE: Duration = Duration::from_secs(5);

const MEDIA_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// What the service has counted since it was started.
#[utoipa::path(get, path = "/metrics", tag = "health", responses(
    (status = 200, description = "OpenMetrics text", body = String,
     content_type = "application/openmetrics-text"),
))]
pub(super) async fn metrics(State(state): State<RestState>, uri: Uri) -> Result<Response, Problem> {
    Params::none(&uri)?;
    let census = tokio::time::timeout(PATIENCE, state.reads.census()).await;
    if let Ok(Err(error)) = &census {
        tracing::warn!(%error, "no census for a monitor");
    }
    // Without it the rest is told all the same: a monitor must see above all a service that is ill.
    state.metrics.see(census.ok().and_then(Result::ok).as_ref());
    let text = state.metrics.text().map_err(|error| Problem::internal(&error))?;
    let kind = [(CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE))];
    Ok((kind, text).into_response())
}
