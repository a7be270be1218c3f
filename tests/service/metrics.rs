//! What a monitor reads.

use reqwest::header::CONTENT_TYPE;

use crate::app::TestApp;
use crate::explanations::explanation;
use crate::field::line;
use crate::time::until;

/// Everything that is counted, as it stands.
pub async fn metrics(app: &TestApp) -> String {
    let answer = app.get("/metrics").await;
    let kind = answer.headers()[CONTENT_TYPE].to_str().unwrap();
    assert!(kind.starts_with("application/openmetrics-text"), "{kind}");
    let text = answer.text().await.unwrap();
    assert!(text.ends_with("# EOF\n"), "{text}");
    text
}

#[tokio::test]
async fn plans_and_explanations_are_counted() {
    let app = TestApp::start().await;
    assert!(!metrics(&app).await.contains("voltour_plans_total{"), "nothing is planned yet");
    app.put(line(2)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    explanation(&app, &tour).await;
    let solver = &tour.solver;
    let planned = format!("voltour_plans_total{{solver=\"{solver}\",status=\"");
    // Counted after the commit, a moment after it can be read.
    let text = until("the counts", || async {
        let text = metrics(&app).await;
        let explained = text.contains("voltour_explanations_total{outcome=\"done\"} 1");
        (explained && text.contains(&planned)).then_some(text)
    });
    let text = text.await;
    for name in ["voltour_plan_time_seconds_bucket{", "# TYPE voltour_plan_gap_ratio"] {
        assert!(text.contains(name), "{name} is not in\n{text}");
    }
    assert!(text.contains("voltour_plan_time_seconds_count 1"), "{text}");
}
