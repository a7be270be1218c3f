//! Only an admin of all networks sees or changes what of the log is written: lines tell of all networks.

use super::{closed, get, token};
use crate::app::TestApp;

const ROUTE: &str = "/v1/log-filter";

async fn put(app: &TestApp, token: Option<&str>) -> u16 {
    let call = reqwest::Client::new().put(format!("{}{ROUTE}", app.rest));
    let call = match token {
        Some(token) => call.bearer_auth(token),
        None => call,
    };
    call.body("{\"filter\": \"debug\"}").send().await.expect("an answer").status().as_u16()
}

#[tokio::test]
async fn nobody_but_an_admin_of_everything_changes_the_log() {
    let app = TestApp::start().await;
    let admin = token(&app, "--role admin --all-networks");
    closed(&app).await;
    assert_eq!(put(&app, None).await, 401);
    for other in ["--role operator --all-networks", "--role admin --network field"] {
        let other = token(&app, other);
        assert_eq!(put(&app, Some(&other)).await, 403);
        assert_eq!(get(&app, ROUTE, Some(&other)).await.status(), 403);
    }
    let shown = get(&app, ROUTE, Some(&admin)).await.text().await.unwrap();
    assert_eq!(shown, "{\"filter\":\"info\"}");
    assert_eq!(put(&app, Some(&admin)).await, 200);
}
