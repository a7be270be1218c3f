//! Which addresses are listened on, and with which token the service begins.

use std::fs;
use std::process::{Command, Stdio};

use tonic::Code;

use super::{command, get, raw, token};
use crate::app::{Settings, TestApp, wait_exit};

const TOKEN: &str = "a-token-that-somebody-else-has-made-0123456789";

/// Everywhere, and not only on loopback.
fn everywhere(app: &TestApp) {
    let config = fs::read_to_string(app.config_path()).unwrap();
    fs::write(app.config_path(), config.replace("127.0.0.1:0", "0.0.0.0:0")).unwrap();
}

#[tokio::test]
async fn without_a_token_it_listens_on_loopback_only_and_says_what_to_do() {
    let mut app = TestApp::start().await;
    app.kill9();
    everywhere(&app);
    let mut server = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["serve", "--config"])
        .arg(app.config_path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let status = wait_exit(&mut server).await.unwrap_or_else(|| {
        let _ = server.kill();
        panic!("it runs");
    });
    let output = server.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(status.code(), Some(2), "{said}");
    for part in
        ["grpc.listen: 0.0.0.0:0", "voltour token create", "VOLTOUR_ACCESS__BOOTSTRAP_TOKEN"]
    {
        assert!(said.contains(part), "{part} is not in: {said}");
    }
    assert!(said.contains(app.database().to_str().unwrap()), "{said}");
    // With one token it does.
    let admin = token(&app, "--role admin --all-networks");
    app.launch().await;
    assert_eq!(get(&app, "/v1/plans", None).await.status(), 401);
    assert_eq!(get(&app, "/v1/plans", Some(&admin)).await.status(), 200);
    // There the name that is spoken to is anybody's choice.
    let call = reqwest::Client::new().get(format!("{}/healthz", app.rest));
    assert_eq!(call.header("host", "voltour.example").send().await.unwrap().status(), 200);
}

#[tokio::test]
async fn a_bootstrap_token_is_an_admins_for_as_long_as_it_is_configured() {
    let mut app = TestApp::start().await;
    app.kill9();
    let file = app.file("token");
    fs::write(&file, format!("{TOKEN}\n")).unwrap();
    let more = format!("[access]\nbootstrap_token_file = {file:?}\n");
    app.configure(Settings { more, ..Settings::default() });
    everywhere(&app);
    app.launch().await;
    assert_eq!(get(&app, "/metrics", None).await.status(), 401);
    assert_eq!(get(&app, "/metrics", Some(TOKEN)).await.status(), 200);
    let list = "/voltour.v1.NetworkService/List";
    assert!(raw::call(app.channel(), list, Some(TOKEN), vec![]).await.is_ok());
    let refused = raw::call(app.channel(), list, None, vec![]).await.unwrap_err();
    assert_eq!(refused.code(), Code::Unauthenticated);
    // As the password of a browser.
    let call = reqwest::Client::new().get(format!("{}/v1/plans", app.rest));
    assert_eq!(call.basic_auth("me", Some(TOKEN)).send().await.unwrap().status(), 200);
    assert!(!app.log().contains(TOKEN));
    assert!(command(&app, &["list"]).stdout.is_empty(), "it is not in the database");
    app.kill9();
    app.configure(Settings::default());
    app.launch().await;
    assert_eq!(get(&app, "/metrics", None).await.status(), 200, "it was the only one");
}

#[tokio::test]
async fn a_token_from_the_environment_is_checked_and_never_shown() {
    let app = TestApp::start().await;
    let serve = |token: &str| {
        Command::new(env!("CARGO_BIN_EXE_voltour"))
            .args(["serve", "--config"])
            .arg(app.config_path())
            .env("VOLTOUR_ACCESS__BOOTSTRAP_TOKEN", token)
            .env("VOLTOUR_STORE__PATH", app.file("other.db"))
            .env("VOLTOUR_GRPC__LISTEN", "0.0.0.0:0")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    };
    let refused = serve("hush-too-short").wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("access.bootstrap_token") && !said.contains("hush"), "{said}");
    let mut server = serve(TOKEN);
    let mut line = String::new();
    let mut stdout = std::io::BufReader::new(server.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut stdout, &mut line).unwrap();
    let _ = server.kill();
    let output = server.wait_with_output().unwrap();
    assert!(line.starts_with("voltour ready grpc=http://0.0.0.0:"), "{line}");
    assert!(!String::from_utf8_lossy(&output.stderr).contains(TOKEN));
}
