//! A request's life: its steps and its ends.

use crate::domain::{DepartureState, Outcome, Refusal, RequestState, TourState};
use crate::store::fixture::{Bench, asks};
use crate::store::{Overdue, RequestFilter, Storing};
use RequestState::{Batched, Open, Planned, Served, Superseded, Withdrawn};

#[tokio::test]
async fn from_open_to_served() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    assert_eq!(request.state, Open);
    let departure = bench.announce("c").await;
    let batch = bench.closed(departure).await;
    assert_eq!(bench.state(request.id).await, Batched);
    assert_eq!(batch.requests.len(), 1);
    let Ok(Storing::Stored(tour)) = bench.store_plan(&batch, &["s1"]).await else { panic!() };
    let stored = bench.store.reads.request(request.id).await.unwrap().unwrap();
    assert_eq!((stored.state, stored.tour_id), (Planned, Some(tour)));
    let visit = bench.visit(tour, "s1", Outcome::Charged).await;
    assert_eq!(visit.served, [request.id]);
    assert_eq!(bench.state(request.id).await, Served);
    let tour = bench.complete(tour).await.unwrap();
    assert_eq!((tour.state, tour.stops[0].outcome), (TourState::Completed, Some(Outcome::Charged)));
    assert_eq!(bench.departure_state(departure).await, DepartureState::Completed);
    assert_eq!(bench.state(request.id).await, Served);
}

#[tokio::test]
async fn what_is_stored_is_what_was_answered() {
    let bench = Bench::new().await;
    let mut asked = asks("s1");
    asked.deadline = Some("2026-01-01T01:00:00.123456789Z".parse().unwrap());
    asked.reward = Some(0.1 + 0.2);
    let answered = bench.try_submit("x", asked).await.unwrap();
    let stored = bench.store.reads.request(answered.id).await.unwrap().unwrap();
    assert_eq!(answered, stored);
}

#[tokio::test]
async fn a_newer_request_supersedes_an_open_one_in_the_same_commit() {
    let bench = Bench::new().await;
    let first = bench.submit("s1").await;
    let second = bench.submit("s1").await;
    assert_eq!((bench.state(first.id).await, bench.state(second.id).await), (Superseded, Open));
    let live = bench.store.reads.live_requests(&"net".parse().unwrap()).await.unwrap();
    assert_eq!(live.0.len(), 1);
    let since = bench.store.reads.requests_since(&"net".parse().unwrap(), 0, 10).await.unwrap();
    let changes: Vec<u64> = since.iter().map(|request| request.change).collect();
    assert_eq!(since.len(), 2);
    assert!(changes[0] < changes[1], "each row has a change of its own: {changes:?}");
    assert_eq!(live.1, changes[1]);
}

#[tokio::test]
async fn a_newer_request_of_a_frozen_sensor_waits_for_the_next_departure() {
    let bench = Bench::new().await;
    let frozen = bench.submit("s1").await;
    let batch = bench.closed(bench.announce("c").await).await;
    let newer = bench.submit("s1").await;
    assert_eq!((bench.state(frozen.id).await, bench.state(newer.id).await), (Batched, Open));
    // Left out by its tour, the older one gives way.
    bench.store_plan(&batch, &[]).await.unwrap();
    assert_eq!((bench.state(frozen.id).await, bench.state(newer.id).await), (Superseded, Open));
}

#[tokio::test]
async fn the_rest_of_the_batch_is_open_again() {
    let bench = Bench::new().await;
    let (stop, rest) = (bench.submit("s1").await, bench.submit("s2").await);
    bench.tour("c", &["s1"]).await;
    assert_eq!((bench.state(stop.id).await, bench.state(rest.id).await), (Planned, Open));
}

#[tokio::test]
async fn a_withdrawal_takes_effect_at_once_only_while_open() {
    let bench = Bench::new().await;
    let open = bench.submit("s0").await;
    assert_eq!(bench.withdraw(open.id).await.unwrap().state, Withdrawn);
    let (left, stop) = (bench.submit("s1").await, bench.submit("s2").await);
    let batch = bench.closed(bench.announce("c").await).await;
    let pending = bench.withdraw(left.id).await.unwrap();
    assert_eq!((pending.state, pending.withdrawal_pending), (Batched, true));
    let Ok(Storing::Stored(tour)) = bench.store_plan(&batch, &["s2"]).await else { panic!() };
    assert_eq!(bench.state(left.id).await, Withdrawn);
    assert!(bench.withdraw(stop.id).await.unwrap().withdrawal_pending);
    bench.visit(tour, "s2", Outcome::Charged).await;
    assert_eq!(bench.state(stop.id).await, Served);
    for ended in [open.id, left.id, stop.id] {
        let refused = bench.withdraw(ended).await;
        assert!(matches!(refused, Err(Refusal::FailedPrecondition(_))), "{refused:?}");
    }
}

#[tokio::test]
async fn completion_cancellation_and_silence_reopen_what_was_not_served() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let tour = bench.tour("c", &["s1"]).await;
    bench.visit(tour, "s1", Outcome::Failed).await;
    assert_eq!(bench.state(request.id).await, Planned);
    bench.complete(tour).await.unwrap();
    assert_eq!(bench.state(request.id).await, Open);

    let tour = bench.tour("c", &["s1"]).await;
    let departure = bench.store.reads.tour(tour).await.unwrap().unwrap().departure_id;
    let cancelled = bench.cancel(departure).await.unwrap();
    assert_eq!(cancelled.state, DepartureState::Cancelled);
    assert_eq!(cancelled.reason.as_deref(), Some("rain"));
    assert_eq!(bench.state(request.id).await, Open);

    let tour = bench.tour("c", &["s1"]).await;
    let after = std::time::Duration::from_secs(1_800);
    let overdue = || bench.store.writer.call(Overdue { tour_id: tour, after });
    bench.advance(3 + 60 + 1_800 - 1);
    assert!(!overdue().await.unwrap());
    bench.advance(1);
    assert!(overdue().await.unwrap());
    assert!(!overdue().await.unwrap());
    let tour = bench.store.reads.tour(tour).await.unwrap().unwrap();
    assert_eq!(tour.state, TourState::Overdue);
    assert_eq!(bench.departure_state(tour.departure_id).await, DepartureState::Overdue);
    assert_eq!(bench.state(request.id).await, Open);
}

#[tokio::test]
async fn a_cancelled_departure_gives_its_batch_back() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let batch = bench.closed(bench.announce("c").await).await;
    bench.cancel(batch.departure.id).await.unwrap();
    assert_eq!(bench.state(request.id).await, Open);
    assert_eq!(bench.store_plan(&batch, &["s1"]).await, Ok(Storing::Gone));
    let again = bench.cancel(batch.departure.id).await;
    assert!(matches!(again, Err(Refusal::FailedPrecondition(_))), "{again:?}");
}

#[tokio::test]
async fn lists_go_newest_first_and_on_from_a_cursor() {
    let bench = Bench::new().await;
    let mut ids = Vec::new();
    for sensor in ["s0", "s1", "s2", "s3", "s4"] {
        ids.insert(0, bench.submit(sensor).await.id);
    }
    let filter = RequestFilter { states: vec![Open, Open], ..RequestFilter::default() };
    let mut page = crate::store::Page { limit: 2, after: None };
    let mut seen = Vec::new();
    loop {
        let listed = bench.store.reads.requests(&filter, &page).await.unwrap();
        seen.extend(listed.items.iter().map(|request| request.id));
        page.after = listed.next;
        if page.after.is_none() {
            break;
        }
    }
    assert_eq!(seen, ids);
}
