//! Who may do what: tokens, roles, networks, chargers; the listeners' addresses, names and certificates.

mod command;
mod escaped;
mod example;
mod host;
mod listening;
mod log_filter;
mod raw;
mod scope;
mod tls;
mod walk;

use std::process::{Command, Output};

use tonic::Code;
use voltour::proto::ListNetworksRequest;

use crate::app::TestApp;
use crate::time::until;

/// `voltour token` on the database of a running service.
fn command(app: &TestApp, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_voltour"))
        .arg("token")
        .args(args)
        .arg("--database")
        .arg(app.database())
        .output()
        .expect("voltour runs")
}

/// A new token; `args` say what it is for.
fn token(app: &TestApp, args: &str) -> String {
    let name = crate::field::fresh("token");
    let args: Vec<&str> = ["create", &name].into_iter().chain(args.split(' ')).collect();
    let output = command(app, &args);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
    String::from_utf8(output.stdout).expect("UTF-8").trim_end().to_owned()
}

/// Waits until the service has noticed that it has tokens.
async fn closed(app: &TestApp) {
    until("the service asks for a token", || async {
        let refused = app.networks().list(ListNetworksRequest::default()).await.err()?;
        (refused.code() == Code::Unauthenticated).then_some(())
    })
    .await;
}

/// The answer of a REST route to whoever has this token.
async fn get(app: &TestApp, path: &str, token: Option<&str>) -> reqwest::Response {
    let mut call = reqwest::Client::new().get(format!("{}{path}", app.rest));
    if let Some(token) = token {
        call = call.bearer_auth(token);
    }
    call.timeout(crate::app::PATIENCE).send().await.expect("an answer")
}
