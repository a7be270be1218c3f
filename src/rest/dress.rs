//! What every answer has: a time limit, a trace, gzip for those who take it, headers for browsers, and a
//! problem document where it is an error, also where no handler was reached.

use std::any::Any;
use std::time::Duration;

use axum::Router;
use axum::extract::Request;
use axum::http::header::{
    ALLOW, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG,
    REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};
use axum::middleware::map_response;
use axum::response::{IntoResponse, Response};
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::timeout::TimeoutLayer;
use tower_http::trace::TraceLayer;

use super::problem::{MEDIA_TYPE, Problem};
use crate::telemetry::of_caller;

/// No answer takes longer to begin.
const LONGEST: Duration = Duration::from_secs(30);

/// The routes with all that.
pub(super) fn dress(routes: Router) -> Router {
    let span = |request: &Request| {
        let (method, path) = (request.method(), request.uri().path());
        of_caller(tracing::info_span!("rest", %method, path), request.headers())
    };
    // A handler has logged its own failure already, so that the trace does not log it again.
    let trace = TraceLayer::new_for_http().make_span_with(span).on_failure(());
    routes
        .fallback(unknown)
        .layer(CatchPanicLayer::custom(defect))
        .layer(TimeoutLayer::with_status_code(StatusCode::GATEWAY_TIMEOUT, LONGEST))
        .layer(CompressionLayer::new())
        .layer(map_response(finish))
        .layer(trace)
}

async fn unknown(request: Request) -> Problem {
    let path: String = request.uri().path().chars().take(200).collect();
    Problem::new(StatusCode::NOT_FOUND).detail(format!("there is nothing at {path:?}"))
}

fn defect(panic: Box<dyn Any + Send>) -> Response {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    Problem::internal(&text.unwrap_or_else(|| "panic".into())).into_response()
}

async fn finish(response: Response) -> Response {
    let mut response = as_problem(response);
    let status = response.status();
    let headers = response.headers_mut();
    let mut default = |name: HeaderName, value: &'static str| {
        headers.entry(name).or_insert(HeaderValue::from_static(value));
    };
    default(X_CONTENT_TYPE_OPTIONS, "nosniff");
    default(REFERRER_POLICY, "no-referrer");
    default(CONTENT_SECURITY_POLICY, "default-src 'none'; frame-ancestors 'none'");
    // What is stored may change at any time, but for plans, which say so themselves.
    default(CACHE_CONTROL, if status.is_success() { "no-cache" } else { "no-store" });
    if headers.contains_key(CONTENT_ENCODING) {
        weaken(headers);
    }
    response
}

/// A strong tag stands for the very bytes, and these are others than without compression (RFC 9110, 8.8.3.3).
fn weaken(headers: &mut HeaderMap) {
    let strong = headers.get(ETAG).and_then(|tag| tag.to_str().ok());
    let weak = strong.filter(|tag| tag.starts_with('"')).map(|tag| format!("W/{tag}"));
    if let Some(Ok(weak)) = weak.as_deref().map(HeaderValue::from_str) {
        headers.insert(ETAG, weak);
    }
}

/// An error that the library made gets a problem document of its status for a body.
fn as_problem(response: Response) -> Response {
    let status = response.status();
    let is_error = status.is_client_error() || status.is_server_error();
    // The layer that compresses leaves the answer of the handler below its 406.
    let is_told = is_problem(response.headers()) && status != StatusCode::NOT_ACCEPTABLE;
    if !is_error || is_told {
        return response;
    }
    let problem = match status {
        StatusCode::METHOD_NOT_ALLOWED => {
            let allowed = response.headers().get(ALLOW).and_then(|allow| allow.to_str().ok());
            Problem::new(status).detail(format!("only {}", allowed.unwrap_or("other methods")))
        }
        StatusCode::PAYLOAD_TOO_LARGE => Problem::new(status).detail("the body is too long"),
        StatusCode::NOT_ACCEPTABLE => {
            Problem::new(status).detail("Accept-Encoding: must leave gzip or identity")
        }
        StatusCode::GATEWAY_TIMEOUT => Problem::new(status).detail("this took too long; try again"),
        status => Problem::new(status),
    };
    let mut answer = problem.into_response();
    if let Some(allow) = response.headers().get(ALLOW) {
        answer.headers_mut().insert(ALLOW, allow.clone());
    }
    answer
}

fn is_problem(headers: &HeaderMap) -> bool {
    headers.get(CONTENT_TYPE).is_some_and(|value| value == MEDIA_TYPE)
}

#[cfg(test)]
mod tests {
    use axum::body::Body;
    use axum::http::Method;
    use axum::http::header::{ACCEPT_ENCODING, VARY};
    use axum::routing::get;
    use tower::ServiceExt;

    use super::*;

    #[allow(clippy::panic, reason = "the handler that fails")]
    async fn broken() -> &'static str {
        panic!("secret")
    }

    async fn ask(method: Method, path: &str) -> (Response, serde_json::Value) {
        ask_encoded(method, path, "identity").await
    }

    async fn ask_encoded(
        method: Method,
        path: &str,
        encoding: &str,
    ) -> (Response, serde_json::Value) {
        let long = || async { ([(ETAG, "\"t\"")], "all work and no play ".repeat(100)) };
        let routes = Router::new()
            .route("/ok", get(|| async { "ok" }))
            .route("/bad", get(broken))
            .route("/long", get(long));
        let request = Request::builder().method(method).uri(path);
        let request = request.header(ACCEPT_ENCODING, encoding).body(Body::empty()).unwrap();
        let response = dress(routes).oneshot(request).await.unwrap();
        let (parts, body) = response.into_parts();
        let body = axum::body::to_bytes(body, 10_000).await.unwrap();
        let json = serde_json::from_slice(&body).unwrap_or_default();
        (Response::from_parts(parts, Body::empty()), json)
    }

    #[tokio::test]
    async fn errors_of_every_kind_are_problems() {
        for (method, path, status) in
            [(Method::GET, "/nowhere", 404), (Method::POST, "/ok", 405), (Method::GET, "/bad", 500)]
        {
            let (response, problem) = ask(method, path).await;
            assert_eq!(response.status(), status, "{path}");
            assert_eq!(response.headers()[CONTENT_TYPE], MEDIA_TYPE);
            assert_eq!(response.headers()[CACHE_CONTROL], "no-store");
            assert_eq!(problem["status"], status);
            assert!(!problem.to_string().contains("secret"));
        }
        let (response, _) = ask(Method::POST, "/ok").await;
        assert_eq!(response.headers()[ALLOW], "GET,HEAD");
    }

    #[tokio::test]
    async fn answers_carry_the_headers_for_browsers() {
        let (response, _) = ask(Method::GET, "/ok").await;
        assert_eq!(response.status(), 200);
        assert_eq!(response.headers()[X_CONTENT_TYPE_OPTIONS], "nosniff");
        assert_eq!(response.headers()[CACHE_CONTROL], "no-cache");
        assert!(response.headers().contains_key(CONTENT_SECURITY_POLICY));
    }
    #[tokio::test]
    async fn who_takes_gzip_gets_it_under_a_weak_tag() {
        let (whole, _) = ask_encoded(Method::GET, "/long", "identity").await;
        assert_eq!(
            (whole.headers()[ETAG].as_bytes(), whole.status().as_u16()),
            (&b"\"t\""[..], 200)
        );
        assert!(!whole.headers().contains_key(CONTENT_ENCODING));
        let (packed, _) = ask_encoded(Method::GET, "/long", "br, gzip;q=0.5").await;
        assert_eq!(packed.headers()[CONTENT_ENCODING], "gzip");
        assert_eq!(packed.headers()[ETAG], "W/\"t\"");
        assert_eq!(packed.headers()[VARY], "accept-encoding");
        let (refused, problem) = ask_encoded(Method::GET, "/long", "identity;q=0, br").await;
        assert_eq!((refused.status().as_u16(), &problem["status"]), (406, &406.into()));
        assert_eq!(refused.headers()[CONTENT_TYPE], MEDIA_TYPE);
    }
}
