//! Of TourService.

use tonic::Code;
use voltour::proto::{
    CompleteRequest, GetNextRequest, ReportVisitRequest, VisitOutcome, WatchToursRequest,
};

use super::{NO_NUMBERS, bad_ids, refused};
use crate::app::TestApp;
use crate::field::{FIELD, completion, line, visit};
use crate::time::from_now;

const UNKNOWN: &str = "0190163d-8694-739b-8ca7-c9f6e6a7b0a1";

/// Reports with one bad field each.
fn bad_reports(tour: &str) -> Vec<(&'static str, ReportVisitRequest)> {
    let v = || visit(tour, "s1", VisitOutcome::Charged);
    let mut all = vec![
        ("outcome", ReportVisitRequest { outcome: 0, ..v() }),
        ("outcome", ReportVisitRequest { outcome: 77, ..v() }),
        ("sensor_id", ReportVisitRequest { sensor_id: String::new(), ..v() }),
        ("sensor_id", ReportVisitRequest { sensor_id: "unknown".into(), ..v() }),
        ("charge_j", ReportVisitRequest { charge_j: Some(-1.0), ..v() }),
        ("note", ReportVisitRequest { note: "ä".repeat(513), ..v() }),
        (
            "departed_at",
            ReportVisitRequest { arrived_at: from_now(0), departed_at: from_now(-1000), ..v() },
        ),
    ];
    for value in NO_NUMBERS {
        all.push(("charge_j", ReportVisitRequest { charge_j: Some(value), ..v() }));
    }
    for id in bad_ids() {
        all.push(("client_id", ReportVisitRequest { client_id: id, ..v() }));
    }
    for id in ["", "7", "0190163d8694739b8ca7c9f6e6a7b0a1"] {
        all.push(("tour_id", ReportVisitRequest { tour_id: id.into(), ..v() }));
    }
    all
}

#[tokio::test]
async fn report_visit_names_the_field() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let asked = app.ask("s1").await;
    let tour = app.drive("A").await;
    for (field, call) in bad_reports(&tour.id) {
        refused(app.tours().report_visit(call).await, field);
    }
    let unknown = visit(UNKNOWN, "s1", VisitOutcome::Charged);
    assert_eq!(app.tours().report_visit(unknown).await.unwrap_err().code(), Code::NotFound);
    assert_eq!(app.state(&asked.id).await, crate::calls::PLANNED, "nothing was stored");
}

#[tokio::test]
async fn complete_names_the_field() {
    let app = TestApp::start().await;
    for id in ["", "tour", "0190163d8694739b8ca7c9f6e6a7b0a1"] {
        refused(app.tours().complete(completion(id)).await, "tour_id");
    }
    for id in bad_ids() {
        let call = CompleteRequest { client_id: id, ..completion(UNKNOWN) };
        refused(app.tours().complete(call).await, "client_id");
    }
    let status = app.tours().complete(completion(UNKNOWN)).await.unwrap_err();
    assert_eq!(status.code(), Code::NotFound);
}

#[tokio::test]
async fn get_next_and_watch_name_the_field() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let next = |network: &str, charger: &str, departure: &str| GetNextRequest {
        network_id: network.into(),
        charger_id: charger.into(),
        departure_id: departure.into(),
    };
    for id in bad_ids() {
        refused(app.tours().get_next(next(&id, "A", "")).await, "network_id");
        refused(app.tours().get_next(next(FIELD, &id, "")).await, "charger_id");
        let watch = WatchToursRequest { network_id: id, charger_id: String::new() };
        refused(app.tours().watch(watch).await, "network_id");
    }
    refused(app.tours().get_next(next(FIELD, "A", "7")).await, "departure_id");
    let watch = WatchToursRequest { network_id: FIELD.into(), charger_id: "no charger".into() };
    refused(app.tours().watch(watch).await, "charger_id");

    for (call, code) in [
        (next("nowhere", "A", ""), Code::NotFound),
        (next(FIELD, "A", UNKNOWN), Code::NotFound),
        (next(FIELD, "A", ""), Code::FailedPrecondition),
    ] {
        let status = app.tours().get_next(call.clone()).await.unwrap_err();
        assert_eq!(status.code(), code, "{call:?}: {status}");
    }
    // Another charger's departure is not this one's.
    let other = app.depart("B").await;
    let status = app.tours().get_next(next(FIELD, "A", &other.id)).await.unwrap_err();
    assert!(matches!(status.code(), Code::NotFound | Code::InvalidArgument), "{status}");
}
