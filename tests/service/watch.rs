//! The three watches: the present state first, then every change, in order, with none lost.

use std::collections::{HashMap, HashSet};

use tonic::Streaming;
use voltour::proto::{
    DepartureState, RequestChange, TourState, WatchDeparturesRequest, WatchRequestsRequest,
    WatchToursRequest,
};

use crate::app::TestApp;
use crate::calls::{MOMENT, OPEN, PLANNED, SERVED, SUPERSEDED, WITHDRAWN, soon};
use crate::field::{FIELD, line, put, request, sensor};

async fn requests(app: &TestApp) -> Streaming<RequestChange> {
    let watch = WatchRequestsRequest { network_id: FIELD.into() };
    soon("Watch", app.requests().watch(watch)).await.expect("Watch").into_inner()
}

async fn next<T>(stream: &mut Streaming<T>) -> T {
    soon("a change", stream.message()).await.expect("a change").expect("no end of the watch")
}

/// Whether nothing more comes for a moment.
async fn silent<T: std::fmt::Debug>(stream: &mut Streaming<T>) {
    if let Ok(more) = tokio::time::timeout(MOMENT, stream.message()).await {
        panic!("nothing happened, and the watch says {more:?}");
    }
}

#[tokio::test]
async fn requests_first_as_they_are_then_as_they_change() {
    let app = TestApp::start().await;
    app.put(line(4)).await;
    let withdrawn = app.ask("s4").await;
    app.withdraw(&withdrawn.id).await;
    let (one, two) = (app.ask("s1").await, app.ask("s2").await);
    let mut watch = requests(&app).await;
    let mut present = [next(&mut watch).await, next(&mut watch).await];
    assert!(present.iter().all(|change| change.initial));
    present.sort_by(|a, b| a.request.as_ref().unwrap().id.cmp(&b.request.as_ref().unwrap().id));
    assert_eq!(present[0].request.as_ref(), Some(&one));
    assert_eq!(present[1].request.as_ref(), Some(&two));
    silent(&mut watch).await;

    app.withdraw(&two.id).await;
    let change = next(&mut watch).await;
    let request = change.request.unwrap();
    assert_eq!((request.id, request.state, change.initial), (two.id, WITHDRAWN, false));
    assert!(change.change > present[1].change);

    let tour = app.drive("A").await;
    let mut last = change.change;
    let mut states = Vec::new();
    while states.last() != Some(&SERVED) {
        let change = next(&mut watch).await;
        assert!(change.change > last, "in the order of change");
        last = change.change;
        let request = change.request.unwrap();
        assert_eq!(request.id, one.id);
        states.push(request.state);
        // Only now: what changes twice in quick succession may be sent once.
        if request.state == PLANNED {
            app.charged(&tour, "s1").await;
        }
    }
    // Being batched may be too short to be sent.
    states.retain(|&state| state != crate::calls::BATCHED);
    assert_eq!(states, [PLANNED, SERVED]);
}

#[tokio::test]
async fn a_watch_sees_its_network_alone() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let other = voltour::proto::PutNetworkRequest { network_id: "other".into(), ..put(line(1)) };
    app.networks().put(other).await.unwrap();
    let mut watch = requests(&app).await;
    let elsewhere = voltour::proto::SubmitRequest { network_id: "other".into(), ..request("s1") };
    app.submit(elsewhere).await;
    silent(&mut watch).await;
}

#[tokio::test]
async fn a_watch_under_load_loses_nothing() {
    const SENSORS: usize = 400;
    let app = TestApp::start().await;
    app.put(line(SENSORS)).await;
    // The watch begins while the requests come in; it is read slowly, and each sensor asks twice.
    let (mut first, mut second) = (app.requests(), app.requests());
    let ask = |round: usize| {
        (1..=SENSORS).map(move |n| {
            let client_id = format!("round{round}-{n}");
            voltour::proto::SubmitRequest { client_id, ..request(&sensor(n).id) }
        })
    };
    let early = tokio::spawn(async move {
        for request in ask(1) {
            first.submit(request).await.unwrap();
        }
    });
    let mut watch = requests(&app).await;
    let late = tokio::spawn(async move {
        early.await.unwrap();
        for request in ask(2) {
            second.submit(request).await.unwrap();
        }
    });
    let mut last: HashMap<String, i32> = HashMap::new();
    let mut seen = 0;
    let mut change_before = 0;
    loop {
        let change = next(&mut watch).await;
        if !change.initial {
            assert!(change.change >= change_before);
            change_before = change.change;
        }
        let request = change.request.unwrap();
        let client = request.submitted.unwrap().client_id;
        last.insert(client, request.state);
        seen += 1;
        if seen % 64 == 0 {
            tokio::time::sleep(std::time::Duration::from_millis(5)).await;
        }
        let open = last.iter().filter(|(id, state)| id.starts_with("round2") && **state == OPEN);
        let gone =
            last.iter().filter(|(id, state)| id.starts_with("round1") && **state == SUPERSEDED);
        // Those of the first round were all seen, open or at once as superseded, and are all over.
        if open.count() == SENSORS && gone.count() == SENSORS {
            break;
        }
    }
    late.await.unwrap();
    assert_eq!(last.len(), 2 * SENSORS);
}

#[tokio::test]
async fn departures_first_as_they_are_then_as_they_change() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let gone = app.drive("A").await;
    app.complete(&gone).await;
    let out = app.drive("A").await;
    let watch = |charger: &str| WatchDeparturesRequest {
        network_id: FIELD.into(),
        charger_id: charger.into(),
    };
    let mut all = app.departures().watch(watch("")).await.unwrap().into_inner();
    let mut of_b = app.departures().watch(watch("B")).await.unwrap().into_inner();
    let change = next(&mut all).await;
    let departure = change.departure.unwrap();
    assert_eq!((departure.id, change.initial), (out.departure_id.clone(), true));

    let tour = app.drive("B").await;
    app.complete(&out).await;
    app.complete(&tour).await;
    let mut last = change.change;
    let mut ends = HashSet::new();
    while ends.len() < 2 {
        let change = next(&mut all).await;
        assert!(!change.initial && change.change > last);
        last = change.change;
        let departure = change.departure.unwrap();
        if departure.state == DepartureState::Completed as i32 {
            ends.insert(departure.id);
        }
    }
    assert_eq!(ends, HashSet::from([out.departure_id, tour.departure_id.clone()]));
    loop {
        let change = next(&mut of_b).await;
        let departure = change.departure.unwrap();
        assert_eq!(departure.id, tour.departure_id, "only those of its charger");
        if departure.state == DepartureState::Completed as i32 {
            break;
        }
    }
}

#[tokio::test]
async fn tours_first_those_out_then_as_they_change() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let out = app.drive("A").await;
    let watch = WatchToursRequest { network_id: FIELD.into(), charger_id: String::new() };
    let mut all = app.tours().watch(watch).await.unwrap().into_inner();
    let change = next(&mut all).await;
    assert_eq!((change.tour.as_ref(), change.initial), (Some(&out), true));

    app.ask("s2").await;
    let other = app.drive("B").await;
    let change = next(&mut all).await;
    assert_eq!((change.tour.as_ref(), change.initial), (Some(&other), false));
    app.charged(&out, "s1").await;
    let change = next(&mut all).await;
    let tour = change.tour.unwrap();
    assert_eq!((&tour.id, tour.stops[0].outcome), (&out.id, 1), "a report is a change of its tour");
    app.complete(&out).await;
    let tour = next(&mut all).await.tour.unwrap();
    assert_eq!((tour.id, tour.state), (out.id, TourState::Completed as i32));
    app.cancel(&other.departure_id).await;
    let tour = next(&mut all).await.tour.unwrap();
    assert_eq!((tour.id, tour.state), (other.id, TourState::Cancelled as i32));
}
