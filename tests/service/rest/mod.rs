//! The REST edge: what an operator reads. Every route, the same facts as over gRPC.

mod agreement;
mod forms;
mod history;
mod lists;
mod picture;
mod problems;

use reqwest::StatusCode;
use reqwest::header::CONTENT_TYPE;
use serde_json::Value;

use crate::app::TestApp;

/// Every item of a list, page by page; `between` is called after each page.
async fn walk(
    app: &TestApp,
    path: &str,
    limit: usize,
    mut between: impl AsyncFnMut(),
) -> Vec<Value> {
    let glue = if path.contains('?') { '&' } else { '?' };
    let (mut items, mut cursor) = (Vec::new(), None);
    loop {
        let page = match &cursor {
            None => format!("{path}{glue}limit={limit}"),
            Some(cursor) => format!("{path}{glue}limit={limit}&cursor={cursor}"),
        };
        let mut page = app.json(&page).await;
        let found = page["items"].as_array_mut().expect("items");
        assert!(found.len() <= limit, "{} on a page of {limit}", found.len());
        items.append(found);
        match page.get("next_cursor").expect("next_cursor").as_str() {
            Some(next) => cursor = Some(next.to_owned()),
            None => return items,
        }
        between().await;
    }
}

/// The values of a member in a list of documents.
fn all<'a>(items: &'a [Value], member: &str) -> Vec<&'a str> {
    items.iter().map(|item| item[member].as_str().unwrap_or_else(|| panic!("{item}"))).collect()
}

/// A problem document with this status; what it says in all.
async fn problem(app: &TestApp, path: &str, status: StatusCode) -> Value {
    let answer = app.get(path).await;
    assert_eq!(answer.status(), status, "{path}");
    let kind = answer.headers().get(CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
    assert_eq!(kind, Some("application/problem+json"), "{path}");
    let problem: Value = answer.json().await.expect("a JSON document");
    assert_eq!(problem["status"], status.as_u16(), "{path}: {problem}");
    for member in ["type", "title", "detail"] {
        assert!(problem[member].is_string(), "{path}: no {member} in {problem}");
    }
    problem
}
