//! Departures of a network are planned one after the other; a charger has at most one tour out.

use voltour::proto::{AnnounceRequest, DepartureState, GetNextRequest, ListDeparturesRequest};

use crate::app::TestApp;
use crate::calls::sensors;
use crate::field::{FIELD, departure, line, put};
use crate::time::{now_us, us, wire};

#[tokio::test]
async fn the_earlier_t0_gets_the_requests() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    app.ask("s2").await;
    let t0 = now_us() + 1_500_000;
    let at = |us| Some(wire(us));
    let later = app.announce(AnnounceRequest { t0: at(t0 + 100_000), ..departure("B") }).await;
    let earlier = app.announce(AnnounceRequest { t0: at(t0), ..departure("A") }).await;
    let (second, first) = (app.tour(&later).await, app.tour(&earlier).await);
    let mut stops = sensors(&first);
    stops.sort_unstable();
    assert_eq!(stops, ["s1", "s2"]);
    assert!(second.stops.is_empty());
    assert!(first.plan_id < second.plan_id, "planned later, though announced first");
}

#[tokio::test]
async fn the_same_t0_is_served_in_the_order_of_announcement() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let t0 = Some(wire(now_us() + 1_500_000));
    let mut announced = Vec::new();
    for charger in ["C", "A", "B"] {
        announced.push(app.announce(AnnounceRequest { t0, ..departure(charger) }).await);
    }
    let mut tours = Vec::new();
    for departure in &announced {
        tours.push(app.tour(departure).await);
    }
    assert_eq!(sensors(&tours[0]), ["s1"]);
    assert!(tours[1].stops.is_empty() && tours[2].stops.is_empty());
    assert!(tours[0].plan_id < tours[1].plan_id && tours[1].plan_id < tours[2].plan_id);
}

#[tokio::test]
async fn another_network_does_not_wait() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let other = voltour::proto::PutNetworkRequest { network_id: "other".into(), ..put(line(1)) };
    app.networks().put(other).await.unwrap();
    app.announce(AnnounceRequest { t0: Some(wire(now_us() + 3_600_000_000)), ..departure("A") })
        .await;
    let elsewhere =
        app.announce(AnnounceRequest { network_id: "other".into(), ..departure("A") }).await;
    app.departure_in(&elsewhere.id, DepartureState::Planned).await;
}

#[tokio::test]
async fn a_charger_has_at_most_one_tour_out() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let first = app.drive("A").await;
    app.ask("s2").await;
    let second = app.depart("A").await;
    // Another charger is not kept waiting by one that is on its way.
    let other = app.drive("B").await;
    assert_eq!(us(&other.start).cmp(&us(&second.t0)), std::cmp::Ordering::Greater);
    let next = GetNextRequest {
        network_id: FIELD.into(),
        charger_id: "A".into(),
        departure_id: String::new(),
    };
    let again = app.tours().get_next(next.clone()).await.unwrap().into_inner();
    assert_eq!(again.id, first.id, "the tour that it is on");
    assert_eq!(app.departure(&second.id).await.plan_id, "");

    app.complete(&first).await;
    let after = app.tour(&second).await;
    assert_ne!(after.id, first.id);
    let now = app.tours().get_next(next).await.unwrap().into_inner();
    assert_eq!(now.id, after.id);
    assert!(us(&after.start) > us(&first.start));
}

#[tokio::test]
async fn departures_are_listed_by_charger_and_state() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let far = Some(wire(now_us() + 3_600_000_000));
    let one = app.announce(AnnounceRequest { t0: far, ..departure("A") }).await;
    let two = app.announce(AnnounceRequest { t0: far, ..departure("B") }).await;
    app.cancel(&two.id).await;
    let list = |charger: &str, states: &[DepartureState]| ListDeparturesRequest {
        network_id: FIELD.into(),
        charger_id: charger.into(),
        states: states.iter().map(|&state| state as i32).collect(),
        ..ListDeparturesRequest::default()
    };
    for (filter, expected) in [
        (list("", &[]), vec![&two.id, &one.id]),
        (list("A", &[]), vec![&one.id]),
        (list("", &[DepartureState::Cancelled]), vec![&two.id]),
        (list("A", &[DepartureState::Cancelled, DepartureState::Missed]), vec![]),
    ] {
        let listed = app.departures().list(filter.clone()).await.unwrap().into_inner();
        let ids: Vec<_> = listed.departures.iter().map(|departure| &departure.id).collect();
        assert_eq!(ids, expected, "{filter:?}");
    }
}
