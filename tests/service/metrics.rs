//! What a monitor reads.

use reqwest::header::CONTENT_TYPE;

use voltour::proto::{AnnounceRequest, SubmitRequest, WatchRequestsRequest};

use crate::app::TestApp;
use crate::explanations::explanation;
use crate::field::{FIELD, departure, line, request};
use crate::time::{from_now, now_us, until};

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
    let timed = format!("voltour_plan_time_seconds_count{{solver=\"{solver}\"}} 1");
    assert!(text.contains(&timed), "{text}");
}

/// The value of a sample; none where there is no such one.
pub fn value(text: &str, sample: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix(sample)?.strip_prefix(' '));
    line.map(|value| value.parse().unwrap_or_else(|_| panic!("{sample} {value}")))
}

/// Waits until a sample has this value.
async fn becomes(app: &TestApp, sample: &str, expected: f64) {
    until(&format!("{sample} {expected}"), || async {
        (value(&metrics(app).await, sample) == Some(expected)).then_some(())
    })
    .await;
}

#[tokio::test]
async fn submissions_are_counted_by_outcome_and_calls_by_code() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let sent = request("s1");
    app.submit(sent.clone()).await;
    app.submit(sent).await;
    app.requests().submit(request("nobody")).await.unwrap_err();
    let bad = SubmitRequest { reward: Some(-1.0), ..request("s2") };
    let items = tokio_stream::iter([request("s2"), bad]);
    let mut answers = app.requests().submit_stream(items).await.unwrap().into_inner();
    while answers.message().await.unwrap().is_some() {}
    let outcome = |outcome: &str| format!("voltour_submissions_total{{outcome=\"{outcome}\"}}");
    becomes(&app, &outcome("accepted"), 2.0).await;
    becomes(&app, &outcome("duplicate"), 1.0).await;
    becomes(&app, &outcome("invalid"), 2.0).await;
    let call = |method: &str, code: &str| {
        format!(
            "voltour_grpc_calls_total{{method=\"voltour.v1.RequestService/{method}\",code=\"{code}\"}}"
        )
    };
    becomes(&app, &call("Submit", "OK"), 2.0).await;
    becomes(&app, &call("Submit", "INVALID_ARGUMENT"), 1.0).await;
    becomes(&app, &call("SubmitStream", "OK"), 1.0).await;
    becomes(&app, "voltour_open_requests", 2.0).await;
    app.get("/v1/requests?limit=0").await;
    app.get("/no/such/route").await;
    let rest = |route: &str, code: u16| {
        format!("voltour_rest_calls_total{{method=\"GET\",route=\"{route}\",code=\"{code}\"}}")
    };
    becomes(&app, &rest("/v1/requests", 400), 1.0).await;
    becomes(&app, &rest("unknown", 404), 1.0).await;
    let text = metrics(&app).await;
    let method = "{method=\"voltour.v1.RequestService/Submit\"}";
    assert_eq!(value(&text, &format!("voltour_grpc_call_time_seconds_count{method}")), Some(3.0));
    assert_eq!(value(&text, "voltour_build_info{version=\"0.1.0\"}"), Some(1.0));
}

#[tokio::test]
async fn the_writer_and_the_database_are_told_of() {
    let app = TestApp::start().await;
    let before = metrics(&app).await;
    assert_eq!(value(&before, "voltour_last_commit_timestamp_seconds"), Some(0.0));
    assert_eq!(value(&before, "voltour_commit_time_seconds_count"), Some(0.0));
    let began_s = now_us() as f64 / 1e6;
    app.put(line(1)).await;
    app.ask("s1").await;
    let text = metrics(&app).await;
    assert_eq!(value(&text, "voltour_commit_batch_commands_sum"), Some(2.0));
    assert!(value(&text, "voltour_commit_time_seconds_count") >= Some(1.0));
    assert!(value(&text, "voltour_last_commit_timestamp_seconds") >= Some(began_s));
    assert_eq!(value(&text, "voltour_database_writable"), Some(1.0));
    becomes(&app, "voltour_writer_queue_commands", 0.0).await;
    let size =
        |file: &str| value(&text, &format!("voltour_database_size_bytes{{file=\"{file}\"}}"));
    assert!(size("database") > Some(0.0) && size("log") > Some(0.0), "{text}");
}

#[tokio::test]
async fn departures_streams_and_connections_are_counted_while_they_are() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let far = app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("A") }).await;
    let state = |state: &str| format!("voltour_departures{{state=\"{state}\"}}");
    becomes(&app, &state("announced"), 1.0).await;
    let tour = app.drive("B").await;
    becomes(&app, &state("planned"), 1.0).await;
    app.complete(&tour).await;
    app.cancel(&far.id).await;
    becomes(&app, &state("announced"), 0.0).await;
    for end in ["completed", "cancelled"] {
        let ended = format!("voltour_departures_ended_total{{state=\"{end}\"}}");
        becomes(&app, &ended, 1.0).await;
    }
    let watch = WatchRequestsRequest { network_id: FIELD.into() };
    let open = app.requests().watch(watch).await.unwrap();
    becomes(&app, "voltour_streams", 1.0).await;
    becomes(&app, "voltour_connections{edge=\"grpc\"}", 1.0).await;
    drop(open);
    becomes(&app, "voltour_streams", 0.0).await;
    let gone =
        "voltour_grpc_calls_total{method=\"voltour.v1.RequestService/Watch\",code=\"CANCELLED\"}";
    becomes(&app, gone, 1.0).await;
    becomes(&app, "voltour_planner_running_departures", 0.0).await;
}
