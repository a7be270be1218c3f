//! What of the log is written, changed while the service runs.

use reqwest::Response;
use serde_json::{Value, json};

use crate::app::{PATIENCE, TestApp};
use crate::field::line;
use crate::time::until;

async fn put(app: &TestApp, body: String) -> Response {
    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    let call = client.put(format!("{}/v1/log-filter", app.rest)).body(body);
    call.header("content-type", "application/json").send().await.unwrap()
}

#[tokio::test]
async fn the_filter_is_shown_and_changed_and_is_in_force_at_once() {
    let app = TestApp::start().await;
    assert_eq!(app.json("/v1/log-filter").await, json!({"filter": "info"}));
    app.put(line(1)).await;
    assert!(!app.log().contains("DEBUG"), "{}", app.log());
    let answer = put(&app, json!({"filter": "info,voltour=debug"}).to_string()).await;
    assert_eq!(answer.status(), 200);
    assert_eq!(answer.json::<Value>().await.unwrap()["filter"], "info,voltour=debug");
    assert_eq!(app.json("/v1/log-filter").await["filter"], "info,voltour=debug");
    app.drive("A").await;
    until("a line of the level that was off", || async {
        app.log().contains("DEBUG").then_some(())
    })
    .await;
    assert!(app.log().contains("the filter of the log was changed"));
}

#[tokio::test]
async fn a_bad_filter_is_refused_by_its_field_and_changes_nothing() {
    let app = TestApp::start().await;
    let long = |bytes| format!("{{\"filter\": \"{}\"}}", "x".repeat(bytes));
    let (long, longest) = (long(1_025), long(65_536));
    for (body, status, says) in [
        ("{\"filter\": \"voltour=loud\"}", 400, "\"filter\""),
        ("{\"filter\": 7}", 400, "\"body\""),
        ("{\"fliter\": \"info\"}", 400, "fliter"),
        ("info", 400, "\"body\""),
        ("", 400, "\"body\""),
        (long.as_str(), 400, "must be at most 1024"),
        (longest.as_str(), 413, "length limit"),
    ] {
        let answer = put(&app, body.to_owned()).await;
        assert_eq!(answer.status(), status, "{body}");
        assert_eq!(answer.headers()["content-type"], "application/problem+json");
        let text = answer.text().await.unwrap();
        assert!(text.contains(says), "{body}: {text}");
    }
    assert_eq!(app.json("/v1/log-filter").await["filter"], "info");
}
