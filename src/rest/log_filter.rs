//! What of the log is written: the one thing that can be changed over REST, for it is no part of what is stored.

use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::extract::rejection::BytesRejection;
use axum::http::Uri;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::RestState;
use super::problem::Problem;
use super::query::{Params, refusal};

/// The longest body.
pub(super) const BODY_BYTES: usize = 65_536;

/// What of the log is written
#[derive(Debug, Deserialize, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Filter {
    /// As `log.filter` in the configuration: a level, or levels of parts
    #[schema(example = "info,voltour=debug", max_length = 1024)]
    filter: String,
}

/// The filter of the log that is in force.
#[utoipa::path(get, path = "/v1/log-filter", operation_id = "log_filter", tag = "log", responses(
    (status = 200, description = "The filter", body = Filter),
))]
pub(super) async fn show(
    State(state): State<RestState>,
    uri: Uri,
) -> Result<Json<Filter>, Problem> {
    Params::none(&uri)?;
    Ok(Json(Filter { filter: state.log.text() }))
}

/// Changes what of the log is written, until it is changed again or the service ends.
#[utoipa::path(put, path = "/v1/log-filter", operation_id = "set_log_filter", tag = "log",
    request_body = Filter, responses(
    (status = 200, description = "The filter that is in force now", body = Filter),
    (status = 413, description = "The body is too long", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn set(
    State(state): State<RestState>,
    uri: Uri,
    body: Result<Bytes, BytesRejection>,
) -> Result<Json<Filter>, Problem> {
    Params::none(&uri)?;
    let body =
        body.map_err(|rejection| Problem::new(rejection.status()).detail(rejection.body_text()))?;
    let asked: Filter = serde_json::from_slice(&body)
        .map_err(|error| refusal("body", format!("must be {{\"filter\": TEXT}}: {error}")))?;
    let before = state.log.text();
    state.log.set(&asked.filter).map_err(|rule| refusal("filter", rule))?;
    tracing::warn!(before, now = asked.filter, "the filter of the log was changed");
    Ok(Json(asked))
}
