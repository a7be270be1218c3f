//! Closing batches: time zero, frozen batches, deadlines, dead sensors, one tour a charger.

use std::time::Duration;

use crate::clock::{Clock, minus, plus};
use crate::domain::{DepartureState, Outcome, RequestState};
use crate::store::fixture::{Bench, LEAD, leaves, spec};
use crate::store::{Batch, Closing, Storing};

fn sensors(batch: &Batch) -> Vec<&str> {
    batch.requests.iter().map(|request| request.asked.sensor_id.as_str()).collect()
}

fn dead(batch: &Batch) -> Vec<&str> {
    batch.dead.iter().map(|sensor| sensor.as_str()).collect()
}

#[tokio::test]
async fn second_0_is_t0_or_a_lead_after_the_close() {
    let bench = Bench::new().await;
    let t0 = bench.later(100);
    let planned = bench.try_announce("a", leaves("c", Some(t0))).await.unwrap();
    assert_eq!((planned.t0, planned.closes_at), (t0, minus(t0, LEAD)));
    bench.advance(97);
    assert_eq!(bench.closed(planned.id).await.start, t0);

    let soon = bench.try_announce("b", leaves("d", None)).await.unwrap();
    assert_eq!((soon.t0, soon.closes_at), (plus(bench.clock.now(), LEAD), bench.clock.now()));
    bench.advance(10);
    let batch = bench.closed(soon.id).await;
    assert_eq!(batch.start, plus(bench.clock.now(), LEAD));
    assert_eq!(batch.departure.start, Some(batch.start));
    assert_eq!(batch.departure.closes_at, bench.clock.now());
    assert_eq!(batch.departure.network_version, Some(1));
}

#[tokio::test]
async fn too_late_is_missed_and_its_requests_are_open() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let departure = bench.announce("c").await;
    bench.closed(departure).await;
    bench.advance(600);
    assert_eq!(bench.closed(departure).await.requests.len(), 1, "just in time");
    bench.clock.advance(Duration::from_micros(1));
    assert!(matches!(bench.close(departure).await, Closing::Missed));
    assert_eq!(bench.departure_state(departure).await, DepartureState::Missed);
    assert_eq!(bench.state(request.id).await, RequestState::Open);
    assert!(matches!(bench.close(departure).await, Closing::Gone));
}

#[tokio::test]
async fn a_deadline_before_second_0_expires_and_its_sensor_is_dead() {
    let bench = Bench::new().await;
    let expired = bench.submit_until("s1", 2).await;
    let last = bench.submit_until("s2", 3).await;
    let batch = bench.closed(bench.announce("c").await).await;
    assert_eq!(bench.state(expired.id).await, RequestState::Expired);
    assert_eq!((sensors(&batch), dead(&batch)), (vec!["s2"], vec!["s1"]));
    assert_eq!(batch.requests[0].id, last.id);
    bench.store_plan(&batch, &["s2"]).await.unwrap();

    // Dead until a newer request brings it back.
    let batch = bench.closed(bench.announce("d").await).await;
    assert_eq!(dead(&batch), ["s1"]);
    bench.store_plan(&batch, &[]).await.unwrap();
    bench.submit("s1").await;
    let batch = bench.closed(bench.announce("e").await).await;
    assert_eq!((sensors(&batch), dead(&batch)), (vec!["s1"], vec![]));
}

#[tokio::test]
async fn a_visit_brings_a_dead_sensor_back() {
    let bench = Bench::new().await;
    bench.submit_until("s1", 2).await;
    let batch = bench.closed(bench.announce("c").await).await;
    let Ok(Storing::Stored(tour)) = bench.store_plan(&batch, &[]).await else { panic!() };
    bench.visit(tour, "s1", Outcome::Skipped).await;
    assert_eq!(dead(&bench.closed(bench.announce("d").await).await), ["s1"]);
    bench.visit(tour, "s1", Outcome::Charged).await;
    assert!(dead(&bench.closed(bench.announce("e").await).await).is_empty());
}

#[tokio::test]
async fn a_sensor_of_a_tour_that_is_out_is_left_out() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let tour = bench.tour("c", &["s1"]).await;
    let newer = bench.submit_until("s1", 1).await;
    let batch = bench.closed(bench.announce("d").await).await;
    assert!(sensors(&batch).is_empty() && dead(&batch).is_empty());
    assert_eq!(bench.state(newer.id).await, RequestState::Open);
    bench.visit(tour, "s1", Outcome::Charged).await;
    assert_eq!(bench.state(newer.id).await, RequestState::Served);
}

#[tokio::test]
async fn a_charger_has_one_tour_out() {
    let bench = Bench::new().await;
    let tour = bench.tour("c", &[]).await;
    let next = bench.announce("c").await;
    assert!(matches!(bench.close(next).await, Closing::ChargerOut));
    assert_eq!(bench.departure_state(next).await, DepartureState::Announced);
    bench.advance(100);
    bench.complete(tour).await.unwrap();
    let batch = bench.closed(next).await;
    assert_eq!(batch.start, plus(bench.clock.now(), LEAD), "late, as after downtime");
}

#[tokio::test]
async fn a_frozen_batch_survives_a_restart_with_a_later_second_0() {
    let bench = Bench::new().await;
    let (kept, expires) = (bench.submit("s1").await, bench.submit_until("s2", 60).await);
    let departure = bench.announce("c").await;
    let first = bench.closed(departure).await;
    bench.withdraw(kept.id).await.unwrap();
    let newer = bench.submit("s1").await;
    let other = bench.submit("s3").await;

    let bench = bench.reopened().await;
    bench.advance(100);
    let waiting = bench.store.reads.waiting().await.unwrap();
    assert_eq!(waiting.iter().map(|waiting| waiting.id).collect::<Vec<_>>(), [departure]);
    let again = bench.closed(departure).await;
    assert_eq!(again.start, plus(bench.clock.now(), LEAD));
    assert_eq!((first.requests.len(), sensors(&again), dead(&again)), (2, vec!["s1"], vec!["s2"]));
    assert_eq!(again.departure.batch_size, 1);
    assert_eq!(bench.state(expires.id).await, RequestState::Expired);
    for open in [newer.id, other.id] {
        assert_eq!(bench.state(open).await, RequestState::Open);
    }
    // The plan of the first close is worth nothing now.
    assert_eq!(bench.store_plan(&first, &["s1"]).await, Ok(Storing::Gone));
    assert!(matches!(bench.store_plan(&again, &["s1"]).await, Ok(Storing::Stored(_))));
}

#[tokio::test]
async fn nothing_is_planned_from_a_second_0_that_has_passed() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let batch = bench.closed(bench.announce("c").await).await;
    bench.clock.set(plus(batch.start, Duration::from_micros(1)));
    assert_eq!(bench.store_plan(&batch, &["s1"]).await, Ok(Storing::Late));
    assert_eq!(bench.state(request.id).await, RequestState::Batched);
}

#[tokio::test]
async fn planned_once() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let batch = bench.closed(bench.announce("c").await).await;
    let Ok(Storing::Stored(tour)) = bench.store_plan(&batch, &["s1"]).await else { panic!() };
    assert_eq!(bench.store_plan(&batch, &["s1"]).await, Ok(Storing::Gone));
    // A departure that claims a request of another is a defect, and nothing of its plan is stored.
    let mut other = bench.closed(bench.announce("d").await).await;
    other.requests = batch.requests.clone();
    assert!(bench.store_plan(&other, &["s1"]).await.is_err());
    assert_eq!(bench.departure_state(other.departure.id).await, DepartureState::Closed);
    let stored = bench.store.reads.request(request.id).await.unwrap().unwrap();
    assert_eq!(stored.tour_id, Some(tour));
    let bench = bench.reopened().await;
    let out = bench.store.reads.tour_out(&"net".parse().unwrap(), &"c".parse().unwrap()).await;
    assert_eq!(out.unwrap().unwrap().id, tour);
}

#[tokio::test]
async fn a_new_version_is_planned_on_by_the_next_close() {
    let bench = Bench::new().await;
    let (kept, gone) = (bench.submit("s1").await, bench.submit("s4").await);
    let mut smaller = spec();
    smaller.sensors.pop();
    assert_eq!(bench.put(smaller.clone()).await.version, 2);
    assert_eq!(bench.put(smaller.clone()).await.version, 2, "the same content is no new version");
    let departure = bench.announce("c").await;
    let batch = bench.closed(departure).await;
    assert_eq!((sensors(&batch), batch.network.version), (vec!["s1"], 2));
    assert_eq!(bench.state(gone.id).await, RequestState::Open);
    assert_eq!(bench.state(kept.id).await, RequestState::Batched);
    // What was closed on a version stays on it.
    bench.put(spec()).await;
    assert_eq!(bench.closed(departure).await.network.version, 2);
}
