//! Free text is somebody else's: wherever it is shown, it is shown and does nothing.

use std::process::Command;

use tonic::Code;
use voltour::proto::VisitOutcome;

use crate::app::TestApp;
use crate::explanations::explanation;
use crate::field::{FIELD, line, request, visit};

/// Ends a line, a string, an element; moves the cursor.
const HOSTILE: &str = "s\n\u{1b}[2J\"'><script>alert(1)</script>&\u{202e}\u{9b}";

#[tokio::test]
async fn a_hostile_name_is_shown_escaped_everywhere() {
    let app = TestApp::start().await;
    let mut spec = line(2);
    spec.sensors[0].id = HOSTILE.into();
    app.put(spec).await;
    app.ask(HOSTILE).await;
    let tour = app.drive("A").await;
    explanation(&app, &tour).await;
    // What is refused names it too.
    let twice = visit(&tour.id, &format!("{HOSTILE}!"), VisitOutcome::Charged);
    let refused = app.tours().report_visit(twice).await.unwrap_err();
    assert_eq!(refused.code(), Code::InvalidArgument);
    let not_a_sensor = app.requests().submit(request(&format!("{HOSTILE}?"))).await.unwrap_err();
    for said in [refused.message(), not_a_sensor.message()] {
        assert!(!said.contains(['\n', '\u{1b}', '\u{9b}']), "{said:?}");
    }
    for path in ["", "/scenario", "/explanation", "/explanation?format=text", ".svg"] {
        let answer = app.get(&format!("/v1/plans/{}{path}", tour.plan_id)).await;
        assert_eq!(answer.headers()["x-content-type-options"], "nosniff");
        let kind = answer.headers()["content-type"].to_str().unwrap().to_owned();
        let text = answer.text().await.unwrap();
        // JSON is for programs, and has an escape of its own for what ends a string.
        let json = kind == "application/json";
        let acts = if json { &['\n', '\u{1b}'][..] } else { &['\u{1b}', '\u{9b}'] };
        assert!(!text.contains(acts), "{path}: {text:?}");
        // A browser acts upon the text of a picture only; the others are no documents to it.
        assert!(kind != "image/svg+xml" || !text.contains("<script"), "{path}: {text}");
        assert!(kind != "text/html", "{path}");
    }
    for args in [&["request", "list", "--network", FIELD][..], &["network", "get", FIELD]] {
        let output = Command::new(env!("CARGO_BIN_EXE_voltour"))
            .args(args)
            .env("VOLTOUR_SERVER", &app.grpc)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(
            text.contains("script") && !text.contains(['\u{1b}', '\u{9b}', '\u{202e}']),
            "{text:?}"
        );
    }
    assert!(!app.log().contains('\u{1b}'), "{:?}", app.log());
}
