//! Problem documents (RFC 9457), and the one place where errors become them.

use axum::Json;
use axum::http::header::{CONTENT_TYPE, RETRY_AFTER};
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use crate::domain::FieldViolation;
use crate::store::StoreError;

/// The media type of problem documents.
pub(super) const MEDIA_TYPE: &str = "application/problem+json";

/// Why there is no answer, as RFC 9457 has it; the type is `about:blank` where the status says it all.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(super) struct Problem {
    #[serde(rename = "type")]
    #[schema(example = "about:blank")]
    kind: &'static str,
    /// What the status is called, or the type
    title: &'static str,
    /// The HTTP status
    #[schema(example = 400)]
    status: u16,
    /// What is wrong with this one
    #[serde(skip_serializing_if = "Option::is_none")]
    detail: Option<String>,
    /// Every field that breaks a rule
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<FieldError>,
}

/// A field that breaks a rule
#[derive(Clone, Debug, PartialEq, Eq, Serialize, ToSchema)]
pub(super) struct FieldError {
    /// The parameter, or the part of the path
    pub field: String,
    /// The value and the rule that it breaks
    pub description: String,
}

impl Problem {
    pub fn new(status: StatusCode) -> Self {
        Self {
            kind: "about:blank",
            title: status.canonical_reason().unwrap_or("Error"),
            status: status.as_u16(),
            detail: None,
            errors: Vec::new(),
        }
    }

    pub fn detail(self, detail: impl Into<String>) -> Self {
        Self { detail: Some(detail.into()), ..self }
    }

    /// There is no such thing.
    pub fn not_found(what: &str, id: impl std::fmt::Display) -> Self {
        Self::new(StatusCode::NOT_FOUND).detail(format!("there is no {what} {id}"))
    }

    /// Something that may be there another time, or that was given up: of a type of its own, for a program
    /// that asks has to tell it from a wrong id.
    pub fn missing(kind: &'static str, title: &'static str) -> Self {
        Self { kind, title, ..Self::new(StatusCode::NOT_FOUND) }
    }

    /// Parameters break rules.
    pub fn invalid(violations: Vec<FieldViolation>) -> Self {
        let field = |v: FieldViolation| FieldError { field: v.field, description: v.description };
        let errors: Vec<_> = violations.into_iter().map(field).collect();
        let one = |e: &FieldError| format!("{}: {}", e.field, e.description);
        let detail = errors.iter().map(one).collect::<Vec<_>>().join("; ");
        Self { errors, ..Self::new(StatusCode::BAD_REQUEST).detail(detail) }
    }

    /// A defect, or a database that does not answer: logged here, once, and told without its inside.
    pub fn internal(error: &dyn std::fmt::Display) -> Self {
        tracing::error!(%error, "a REST call failed");
        Self::new(StatusCode::INTERNAL_SERVER_ERROR).detail("the service failed; its log says why")
    }

    /// Not now.
    pub fn unavailable(detail: &str) -> Self {
        Self::new(StatusCode::SERVICE_UNAVAILABLE).detail(detail)
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        if error.is_busy() {
            return Self::unavailable("the database is busy; try again");
        }
        Self::internal(&error)
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = (status, Json(self)).into_response();
        let headers = response.headers_mut();
        headers.insert(CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
        if [StatusCode::SERVICE_UNAVAILABLE, StatusCode::TOO_MANY_REQUESTS].contains(&status) {
            headers.insert(RETRY_AFTER, HeaderValue::from_static("1"));
        }
        response
    }
}
