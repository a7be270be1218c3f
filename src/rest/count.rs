//! Around every call: counts it by its route, never by its path.

use axum::extract::{MatchedPath, Request, State};
use axum::middleware::Next;
use axum::response::Response;

use crate::metrics::Calls;

/// The layer.
pub(super) async fn count(State(calls): State<Calls>, call: Request, next: Next) -> Response {
    let route = call.extensions().get::<MatchedPath>().map(MatchedPath::as_str);
    let answered = calls.rest(call.method().as_str(), route);
    let answer = next.run(call).await;
    answered(answer.status().as_u16());
    answer
}
