//! `voltour token`, and what the operator's commands do with a token.

use std::process::Command;

use serde_json::Value;

use super::{closed, command};
use crate::app::TestApp;
use crate::field::line;

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("UTF-8")
}

#[tokio::test]
async fn a_token_is_shown_once_and_stored_hashed() {
    let mut app = TestApp::start().await;
    let args = ["create", "truck-1", "--role", "charger", "--network", "north", "--charger", "t:1"];
    let made = command(&app, &args);
    let token = text(made.stdout);
    let token = token.strip_suffix('\n').expect("a line");
    assert!(token.starts_with("voltour_") && token.len() == 51, "nothing else is printed: {token}");
    let again = command(&app, &args);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(again.stderr).contains("there is a token truck-1 already"));
    let listed = text(command(&app, &["list", "--json"]).stdout);
    let listed: Value = serde_json::from_str(&listed).expect("one object");
    assert_eq!(
        (&listed["name"], &listed["role"], &listed["networks"][0], &listed["charger_id"]),
        (&"truck-1".into(), &"charger".into(), &"north".into(), &"t:1".into())
    );
    assert!(listed.get("token").is_none());
    assert_eq!(command(&app, &["revoke", "truck-1"]).status.code(), Some(0));
    let again = command(&app, &["revoke", "truck-1"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(command(&app, &["list"]).stdout.is_empty());
    let all = text(command(&app, &["list", "--revoked"]).stdout);
    assert!(
        all.starts_with("truck-1  charger  charger t:1  north  made ") && all.contains("revoked")
    );
    app.sigterm().await;
    for file in std::fs::read_dir(app.database().parent().unwrap()).unwrap() {
        let bytes = std::fs::read(file.unwrap().path()).unwrap();
        assert!(!bytes.windows(20).any(|part| part == &token.as_bytes()[8..28]), "it is nowhere");
    }
}

#[tokio::test]
async fn what_makes_no_token_is_said_and_makes_none() {
    let app = TestApp::start().await;
    for (args, says) in [
        ("create a --role charger --network north", "--charger: a token of the role charger"),
        (
            "create a --role admin --all-networks --charger x",
            "--charger: x goes with the role charger",
        ),
        ("create a --role root --all-networks", "must be one of base_station"),
        ("create a --role admin", "--network"),
        ("create a/b --role admin --all-networks", "must be 1 to 64"),
        ("revoke nobody", "there is no token nobody"),
    ] {
        let args: Vec<&str> = args.split(' ').collect();
        let refused = command(&app, &args);
        let said = text(refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{args:?}: {said}");
        assert!(refused.stdout.is_empty() && said.contains(says), "{args:?}: {said}");
    }
    assert!(command(&app, &["list", "--revoked"]).stdout.is_empty());
    // The service still needs none.
    assert_eq!(app.put(line(1)).await.version, 1);
    let nowhere = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["token", "list", "--database"])
        .arg(app.file("nowhere.db"))
        .output()
        .unwrap();
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(text(nowhere.stderr).contains("there is no database"));
    assert!(!app.file("nowhere.db").exists());
}

#[tokio::test]
async fn the_operators_commands_take_a_token() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let north = super::token(&app, "--role operator --network north");
    let field = super::token(&app, "--role operator --network field");
    closed(&app).await;
    let list = |token: Option<&str>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
        command.args(["network", "list"]).env("VOLTOUR_SERVER", &app.grpc);
        token.map(|token| command.env("VOLTOUR_TOKEN", token));
        let output = command.output().unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    assert!(list(Some(&field)).1.starts_with("field "));
    assert_eq!(list(Some(&north)).1, "");
    let (code, _, said) = list(None);
    assert_eq!(code, Some(1));
    assert!(said.contains("not let in: a token is needed"), "{said}");
    let (code, _, said) = list(Some("nonsense"));
    assert_eq!(code, Some(2));
    assert!(said.contains("--token") && !said.contains("nonsense"), "{said}");
}
