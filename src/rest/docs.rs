//! A page that shows the OpenAPI document and lets one try it: a renderer that is part of the binary, so that nothing
//! is fetched from another host.

use std::sync::{Arc, LazyLock};

use axum::body::Body;
use axum::extract::Path;
use axum::extract::rejection::PathRejection;
use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE};
use axum::http::{HeaderValue, Uri};
use axum::response::{IntoResponse, Redirect, Response};
use utoipa_swagger_ui::Config;

use super::problem::Problem;
use super::query::Params;

/// The page runs its own scripts and asks this service, and nobody else.
const POLICY: &str = "default-src 'none'; script-src 'self'; connect-src 'self'; img-src 'self' data:; \
                      style-src 'self' 'unsafe-inline'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";

static CONFIG: LazyLock<Arc<Config<'static>>> = LazyLock::new(|| {
    let config = Config::from("/openapi.json").use_base_layout();
    // Else the page asks a host of others whether the document is good.
    Arc::new(config.validator_url("none").try_it_out_enabled(true))
});

/// The page's files are named relative to it.
pub(super) async fn to_page(uri: Uri) -> Result<Response, Problem> {
    Params::none(&uri)?;
    Ok(Redirect::permanent("/docs/").into_response())
}

/// The page.
pub(super) async fn page(uri: Uri) -> Result<Response, Problem> {
    Params::none(&uri)?;
    answer("index.html")
}

/// One of its files.
pub(super) async fn file(
    name: Result<Path<String>, PathRejection>,
    uri: Uri,
) -> Result<Response, Problem> {
    Params::none(&uri)?;
    answer(&name.map(|Path(name)| name).unwrap_or_default())
}

fn answer(name: &str) -> Result<Response, Problem> {
    let found = utoipa_swagger_ui::serve(name, CONFIG.clone());
    let found = found.map_err(|error| Problem::internal(&error))?;
    let file = found.filter(|_| !name.is_empty()).ok_or_else(|| {
        let name: String = name.chars().take(80).collect();
        Problem::not_found("file", format!("{name:?}"))
    })?;
    let body = match file.bytes {
        std::borrow::Cow::Borrowed(bytes) => Body::from(bytes),
        std::borrow::Cow::Owned(bytes) => Body::from(bytes),
    };
    let mut response = Response::new(body);
    let headers = response.headers_mut();
    let kind = HeaderValue::from_str(&file.content_type);
    headers.insert(CONTENT_TYPE, kind.map_err(|error| Problem::internal(&error))?);
    headers.insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    Ok(response)
}
