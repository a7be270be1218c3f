//! What REST refuses, it refuses with a problem document (RFC 9457).

use reqwest::{Method, StatusCode};

use super::problem;
use crate::app::TestApp;
use crate::field::line;

const UNKNOWN: &str = "0190163d-8694-739b-8ca7-c9f6e6a7b0a1";

#[tokio::test]
async fn there_is_no_such_thing() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    for path in ["networks", "requests", "departures", "plans"] {
        problem(&app, &format!("/v1/{path}/{UNKNOWN}"), StatusCode::NOT_FOUND).await;
    }
    problem(&app, &format!("/v1/plans/{UNKNOWN}/scenario"), StatusCode::NOT_FOUND).await;
    problem(&app, &format!("/v1/plans/{UNKNOWN}.svg"), StatusCode::NOT_FOUND).await;
    problem(&app, "/v1/nothing", StatusCode::NOT_FOUND).await;
    problem(&app, "/", StatusCode::NOT_FOUND).await;
}

#[tokio::test]
async fn what_is_wrong_with_a_query_is_named() {
    let app = TestApp::start().await;
    for (path, named) in [
        ("requests?limit=0", "limit"),
        ("requests?limit=501", "limit"),
        ("plans?limit=-1", "limit"),
        ("departures?limit=many", "limit"),
        ("networks?cursor=!", "cursor"),
        ("requests?cursor=%27%20OR%201", "cursor"),
        ("requests?state=hungry", "state"),
        ("departures?state=open", "state"),
        ("plans?status=fine", "status"),
        ("plans?solver=nobody", "solver"),
        ("plans?from=yesterday", "from"),
        ("plans?until=2026-13-01T00:00:00Z", "until"),
        ("requests?network=no%20network", "network"),
        ("departures?charger=no%20charger", "charger"),
        ("requests?colour=red", "colour"),
    ] {
        let problem = problem(&app, &format!("/v1/{path}"), StatusCode::BAD_REQUEST).await;
        let said = problem.to_string();
        assert!(said.contains(named), "{path}: {said}");
    }
    for path in ["requests/7", "departures/x", "plans/7", "plans/7.svg"] {
        problem(&app, &format!("/v1/{path}"), StatusCode::BAD_REQUEST).await;
    }
}

#[tokio::test]
async fn nothing_is_changed_over_rest() {
    let app = TestApp::start().await;
    let client = reqwest::Client::new();
    for method in [Method::POST, Method::PUT, Method::DELETE, Method::PATCH] {
        let address = format!("{}/v1/networks", app.rest);
        let answer = client.request(method.clone(), address).send().await.unwrap();
        assert_eq!(answer.status(), StatusCode::METHOD_NOT_ALLOWED, "{method}");
        let kind = answer.headers()["content-type"].to_str().unwrap();
        assert_eq!(kind, "application/problem+json", "{method}");
    }
}
