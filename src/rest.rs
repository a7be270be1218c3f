//! Stands in until the REST edge is merged.

use axum::Router;
use tokio_util::sync::CancellationToken;

use crate::store::Reads;

/// No routes yet.
pub fn router(_reads: Reads, _stop: CancellationToken) -> Router {
    Router::new()
}
