//! Answers that never change: a strong tag, a long life in caches, and 304 for those who have it.

use axum::body::Body;
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG, IF_NONE_MATCH, VARY,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};
use axum::response::Response;

/// A picture holds styles and nothing else that a browser would run or load.
const PICTURE_POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; sandbox";

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A form of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Plan,
    Scenario,
    Svg,
    GeoJson,
    Explanation,
    ExplanationText,
}

impl Form {
    fn media_type(self) -> &'static str {
        match self {
            Self::Plan | Self::Scenario | Self::Explanation => "application/json",
            Self::ExplanationText => "text/plain; charset=utf-8",
            Self::Svg => "image/svg+xml",
            Self::GeoJson => "application/geo+json",
        }
    }

    /// The strong tag. What is stored never changes; how it is drawn or told may, with the version.
    pub fn tag(self, id: &str) -> String {
        match self {
            Self::Plan => format!("\"{id}\""),
            Self::Scenario => format!("\"{id}-scenario\""),
            Self::Svg => format!("\"{id}-svg-{VERSION}\""),
            Self::GeoJson => format!("\"{id}-geojson-{VERSION}\""),
            Self::Explanation => format!("\"{id}-explanation\""),
            Self::ExplanationText => format!("\"{id}-explanation-text-{VERSION}\""),
        }
    }
}

/// The tag as the caller has it, where it has what bears this tag (RFC 9110, 13.1.2: weak comparison).
pub(super) fn known<'a>(headers: &'a HeaderMap, tag: &'a str) -> Option<&'a str> {
    let lists = headers.get_all(IF_NONE_MATCH).iter().filter_map(|list| list.to_str().ok());
    let mut tags = lists.flat_map(|list| list.split(',')).map(str::trim);
    let same = |known: &str| known == "*" || known.strip_prefix("W/").unwrap_or(known) == tag;
    tags.find(|known| same(known)).map(|known| if known == "*" { tag } else { known })
}

/// The answer that says: what you have under this tag is still right.
pub(super) fn not_modified(form: Form, tag: &str) -> Response {
    let mut response = Response::new(Body::empty());
    *response.status_mut() = StatusCode::NOT_MODIFIED;
    set(&mut response, form, tag);
    response
}

/// The whole answer.
pub(super) fn whole(form: Form, tag: &str, body: impl Into<Body>) -> Response {
    let mut response = Response::new(body.into());
    set(&mut response, form, tag);
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(form.media_type()));
    response
}

fn set(response: &mut Response, form: Form, tag: &str) {
    let headers = response.headers_mut();
    let mut set = |name: HeaderName, value: &'static str| {
        headers.insert(name, HeaderValue::from_static(value));
    };
    set(CACHE_CONTROL, "private, max-age=31536000, immutable");
    match form {
        Form::Svg => set(CONTENT_SECURITY_POLICY, PICTURE_POLICY),
        // One address for both.
        Form::Explanation | Form::ExplanationText => set(VARY, "accept"),
        Form::Plan | Form::Scenario | Form::GeoJson => {}
    }
    // A tag is made of an id and a version: always a header value.
    if let Ok(tag) = HeaderValue::from_str(tag) {
        headers.insert(ETAG, tag);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn knows(list: &'static str) -> bool {
        let headers = HeaderMap::from_iter([(IF_NONE_MATCH, HeaderValue::from_static(list))]);
        known(&headers, "\"a-b\"").is_some()
    }

    #[test]
    fn tags_are_compared_as_the_standard_says() {
        assert!(knows("\"a-b\"") && knows("*") && knows("W/\"a-b\"") && knows("\"x\" , \"a-b\""));
        assert!(!knows("a-b") && !knows("\"a-b-svg\"") && !knows(""));
        assert_eq!(known(&HeaderMap::new(), "\"a-b\""), None);
        // Weak for a compressed copy; a cache finds it by the tag that it keeps.
        let weak =
            HeaderMap::from_iter([(IF_NONE_MATCH, HeaderValue::from_static("\"x\", W/\"t\""))]);
        assert_eq!(known(&weak, "\"t\""), Some("W/\"t\""));
        let any = HeaderMap::from_iter([(IF_NONE_MATCH, HeaderValue::from_static("*"))]);
        assert_eq!(known(&any, "\"t\""), Some("\"t\""));
    }

    #[test]
    fn every_form_has_a_tag_of_its_own() {
        use Form::{Explanation, ExplanationText, GeoJson, Plan, Scenario, Svg};
        let forms = [Plan, Scenario, Svg, GeoJson, Explanation, ExplanationText];
        let tags = HashSet::from(forms.map(|form| form.tag("id")));
        assert_eq!(tags.len(), forms.len());
    }

    #[test]
    fn immutable_answers_say_so() {
        let response = whole(Form::Svg, "\"t\"", "<svg/>");
        assert_eq!(response.headers()[ETAG], "\"t\"");
        assert!(response.headers()[CACHE_CONTROL].to_str().unwrap().contains("immutable"));
        assert_eq!(response.headers()[CONTENT_TYPE], "image/svg+xml");
        let response = not_modified(Form::Plan, "\"t\"");
        assert_eq!(response.status(), 304);
        assert_eq!(response.headers()[ETAG], "\"t\"");
    }
}
