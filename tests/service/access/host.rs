//! The name that a caller of the REST edge believes to speak to.

use reqwest::header::HOST;

use crate::app::TestApp;

async fn status(app: &TestApp, path: &str, host: &str) -> (u16, String) {
    let call = reqwest::Client::new().get(format!("{}{path}", app.rest)).header(HOST, host);
    let answer = call.send().await.expect("an answer");
    (answer.status().as_u16(), answer.text().await.expect("a body"))
}

#[tokio::test]
async fn on_loopback_only_names_of_this_machine_are_answered_to() {
    let app = TestApp::start().await;
    for host in ["localhost", "LOCALHOST:7480", "127.0.0.1", "127.0.0.2:1", "[::1]:7480"] {
        assert_eq!(status(&app, "/v1/plans", host).await.0, 200, "{host}");
    }
    for host in
        ["evil.example", "127.0.0.1.evil.example", "localhost.evil.example:7480", "10.0.0.1"]
    {
        for path in ["/v1/plans", "/metrics", "/openapi.json", "/healthz"] {
            let (code, said) = status(&app, path, host).await;
            assert_eq!(code, 421, "{path} of {host}");
            assert!(said.contains("rest.hosts") && said.contains(host), "{said}");
        }
    }
}

#[tokio::test]
async fn further_names_are_answered_to_if_they_are_configured() {
    let mut app = TestApp::start().await;
    let config = std::fs::read_to_string(app.config_path()).unwrap();
    let config = config.replace("[rest]\n", "[rest]\nhosts = [\"Plans.example\"]\n");
    std::fs::write(app.config_path(), config).unwrap();
    app.restart().await;
    assert_eq!(status(&app, "/v1/plans", "plans.example:443").await.0, 200);
    assert_eq!(status(&app, "/v1/plans", "other.example").await.0, 421);
}
