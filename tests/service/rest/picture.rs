//! The picture of a plan, the OpenAPI document, and whether the service lives.

use reqwest::header::CONTENT_TYPE;

use crate::app::TestApp;
use crate::field::{covered, line};

#[tokio::test]
async fn of_a_plan_is_well_formed_and_escapes_names() {
    let app = TestApp::start().await;
    let mut spec = covered(4, 2);
    spec.sensors[1].id = "</svg><script>alert(\"1\")</script>&'".into();
    let odd = spec.sensors[1].id.clone();
    app.put(spec).await;
    app.ask(&odd).await;
    for sensor in ["s1", "s3", "s4"] {
        app.ask(sensor).await;
    }
    let tour = app.drive("A").await;
    let answer = app.get(&format!("/v1/plans/{}.svg", tour.plan_id)).await;
    assert_eq!(answer.status(), 200);
    let kind = answer.headers()[CONTENT_TYPE].to_str().unwrap();
    assert!(kind.starts_with("image/svg+xml"), "{kind}");
    let svg = answer.text().await.unwrap();
    assert!(svg.contains("<svg") && !svg.contains("<script"), "{svg}");
    roxmltree::Document::parse(&svg).unwrap_or_else(|error| panic!("{error}: {svg}"));
}

#[tokio::test]
async fn of_an_empty_plan_is_well_formed() {
    let app = TestApp::start().await;
    app.put(line(0)).await;
    let tour = app.drive("A").await;
    let answer = app.get(&format!("/v1/plans/{}.svg", tour.plan_id)).await;
    assert_eq!(answer.status(), 200);
    let svg = answer.text().await.unwrap();
    roxmltree::Document::parse(&svg).unwrap_or_else(|error| panic!("{error}: {svg}"));
}

#[tokio::test]
async fn the_openapi_document_names_every_route() {
    let app = TestApp::start().await;
    let document = app.json("/openapi.json").await;
    assert!(document["openapi"].as_str().unwrap().starts_with("3."));
    let paths = document["paths"].as_object().unwrap();
    for path in [
        "/v1/networks",
        "/v1/networks/{id}",
        "/v1/requests",
        "/v1/requests/{id}",
        "/v1/departures",
        "/v1/departures/{id}",
        "/v1/plans",
        "/v1/plans/{id}",
        "/v1/plans/{id}/scenario",
        "/v1/plans/{id}/explanation",
    ] {
        assert!(paths.contains_key(path), "{path} is not in {:?}", paths.keys());
    }
}

#[tokio::test]
async fn it_lives_and_is_ready() {
    let app = TestApp::start().await;
    for path in ["/healthz", "/readyz"] {
        assert_eq!(app.get(path).await.status(), 200, "{path}");
    }
}
