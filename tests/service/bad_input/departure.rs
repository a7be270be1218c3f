//! Of DepartureService.

use tonic::Code;
use voltour::proto::{
    AnnounceRequest, CancelDepartureRequest, GetDepartureRequest, ListDeparturesRequest,
    WatchDeparturesRequest,
};

use super::{NO_NUMBERS, bad_ids, refused};
use crate::app::TestApp;
use crate::field::{cancellation, charger_type, departure, line, point};
use crate::time::from_now;

/// Announcements with one bad field each.
fn bad_announcements() -> Vec<(&'static str, AnnounceRequest)> {
    let a = || departure("A");
    let mut all = vec![
        ("charger_type", AnnounceRequest { charger_type: "bicycle".into(), ..a() }),
        ("charger_type", AnnounceRequest { charger_type: "a bicycle".into(), ..a() }),
        ("capacity_j", AnnounceRequest { capacity_j: Some(-1.0), ..a() }),
        ("timespan_s", AnnounceRequest { timespan_s: Some(-1.0), ..a() }),
        ("t0", AnnounceRequest { t0: from_now(-120_000), ..a() }),
        ("t0", AnnounceRequest { t0: from_now(8 * 86_400_000), ..a() }),
    ];
    for value in NO_NUMBERS {
        all.extend([
            ("capacity_j", AnnounceRequest { capacity_j: Some(value), ..a() }),
            ("timespan_s", AnnounceRequest { timespan_s: Some(value), ..a() }),
            ("start_m.x_m", AnnounceRequest { start_m: point(value, 0.0), ..a() }),
            ("end_m.y_m", AnnounceRequest { end_m: point(0.0, value), ..a() }),
        ]);
    }
    for id in bad_ids() {
        all.extend([
            ("client_id", AnnounceRequest { client_id: id.clone(), ..a() }),
            ("network_id", AnnounceRequest { network_id: id.clone(), ..a() }),
            ("charger_id", AnnounceRequest { charger_id: id, ..a() }),
        ]);
    }
    all
}

#[tokio::test]
async fn announce_names_the_field() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    for (field, call) in bad_announcements() {
        refused(app.departures().announce(call).await, field);
    }
    let elsewhere = AnnounceRequest { network_id: "nowhere".into(), ..departure("A") };
    let status = app.departures().announce(elsewhere).await.unwrap_err();
    assert_eq!(status.code(), Code::NotFound);
    let all = app.departures().list(ListDeparturesRequest::default()).await.unwrap().into_inner();
    assert!(all.departures.is_empty(), "nothing of a refused call is stored");
}

#[tokio::test]
async fn of_several_charger_types_one_must_be_named() {
    let app = TestApp::start().await;
    let mut spec = line(1);
    let van = voltour::proto::ChargerType { name: "van".into(), ..charger_type() };
    spec.charger_types.push(van);
    app.put(spec).await;
    refused(app.departures().announce(departure("A")).await, "charger_type");
    let named = AnnounceRequest { charger_type: "van".into(), ..departure("A") };
    let stored = app.announce(named).await;
    assert_eq!(stored.announced.unwrap().charger_type, "van");
}

#[tokio::test]
async fn cancel_get_and_watch_name_the_field() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let far = AnnounceRequest { t0: from_now(3_600_000), ..departure("A") };
    let announced = app.announce(far).await;
    let fine = cancellation(&announced.id);
    for id in ["", "A", "0190163d8694739b8ca7c9f6e6a7b0a1"] {
        let call = CancelDepartureRequest { departure_id: id.into(), ..fine.clone() };
        refused(app.departures().cancel(call).await, "departure_id");
        let get = GetDepartureRequest { departure_id: id.into() };
        refused(app.departures().get(get).await, "departure_id");
    }
    for id in bad_ids() {
        let call = CancelDepartureRequest { client_id: id.clone(), ..fine.clone() };
        refused(app.departures().cancel(call).await, "client_id");
        let watch = WatchDeparturesRequest { network_id: id, charger_id: String::new() };
        refused(app.departures().watch(watch).await, "network_id");
    }
    let long = CancelDepartureRequest { reason: "x".repeat(257), ..fine.clone() };
    refused(app.departures().cancel(long).await, "reason");
    let watch =
        WatchDeparturesRequest { network_id: "field".into(), charger_id: "no charger".into() };
    refused(app.departures().watch(watch).await, "charger_id");
    let unknown = "0190163d-8694-739b-8ca7-c9f6e6a7b0a1".to_owned();
    let call = CancelDepartureRequest { departure_id: unknown.clone(), ..fine };
    assert_eq!(app.departures().cancel(call).await.unwrap_err().code(), Code::NotFound);
    let get = GetDepartureRequest { departure_id: unknown };
    assert_eq!(app.departures().get(get).await.unwrap_err().code(), Code::NotFound);
    let watch = WatchDeparturesRequest { network_id: "nowhere".into(), charger_id: String::new() };
    assert_eq!(app.departures().watch(watch).await.unwrap_err().code(), Code::NotFound);
}
