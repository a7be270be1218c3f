//! Whether the process lives, and whether calls are to be sent to it.

use std::time::Duration;

use axum::Json;
use axum::extract::State;
use axum::http::Uri;
use serde::Serialize;
use utoipa::ToSchema;

use super::RestState;
use super::problem::Problem;
use super::query::Params;

/// A database that answers later is not ready.
const PATIENCE: Duration = Duration::from_secs(2);

/// All is well
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Health {
    #[schema(example = "ok")]
    status: &'static str,
}

const OK: Json<Health> = Json(Health { status: "ok" });

/// The process lives.
#[utoipa::path(get, path = "/healthz", tag = "health", responses(
    (status = 200, description = "The process lives", body = Health),
))]
pub(super) async fn healthz(uri: Uri) -> Result<Json<Health>, Problem> {
    Params::none(&uri)?;
    Ok(OK)
}

/// The database answers and can be written, and the service is not going down.
#[utoipa::path(get, path = "/readyz", tag = "health", responses(
    (status = 200, description = "Send calls", body = Health),
    (status = 503, description = "Send none now", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn readyz(
    State(state): State<RestState>,
    uri: Uri,
) -> Result<Json<Health>, Problem> {
    Params::none(&uri)?;
    if state.shutting_down.is_cancelled() {
        return Err(Problem::unavailable("the service is shutting down"));
    }
    if let Some(trouble) = *state.reads.trouble().borrow() {
        return Err(Problem::unavailable(&trouble.to_string()));
    }
    match tokio::time::timeout(PATIENCE, state.reads.ping()).await {
        Ok(Ok(())) => Ok(OK),
        Ok(Err(error)) => {
            tracing::warn!(%error, "not ready");
            Err(Problem::unavailable("the database does not answer"))
        }
        Err(_) => Err(Problem::unavailable("the database is slow to answer")),
    }
}
