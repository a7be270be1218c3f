//! Visit reports: always stored, and what they serve.

use std::time::Duration;

use crate::clock::{Clock, minus};
use crate::domain::{NewVisit, Outcome, Refusal, RequestState};
use crate::store::Overdue;
use crate::store::fixture::{Bench, report};

#[tokio::test]
async fn a_visit_serves_what_was_received_before_it_and_nothing_later() {
    let bench = Bench::new().await;
    let stop = bench.submit("s1").await;
    let tour = bench.tour("c", &["s1"]).await;
    bench.advance(10);
    let newer = bench.submit("s1").await;
    let before = minus(bench.clock.now(), Duration::from_secs(1));
    let early = NewVisit {
        arrived_at: Some(before),
        departed_at: Some(before),
        ..report(tour, "s1", Outcome::Charged)
    };
    assert_eq!(bench.try_visit("early", early).await.unwrap().served, [stop.id]);
    assert_eq!(bench.state(newer.id).await, RequestState::Open);
    let now =
        NewVisit { departed_at: Some(bench.clock.now()), ..report(tour, "s1", Outcome::Charged) };
    assert_eq!(bench.try_visit("now", now).await.unwrap().served, [newer.id]);
}

#[tokio::test]
async fn a_visit_off_the_tour_is_stored_and_serves() {
    let bench = Bench::new().await;
    let tour = bench.tour("c", &[]).await;
    let request = bench.submit("s2").await;
    assert_eq!(bench.visit(tour, "s2", Outcome::Charged).await.served, [request.id]);
    assert!(bench.visit(tour, "s3", Outcome::Charged).await.served.is_empty());
    let unknown = bench.try_visit("x", report(tour, "s9", Outcome::Charged)).await;
    assert!(matches!(unknown, Err(Refusal::Invalid(_))), "{unknown:?}");
}

#[tokio::test]
async fn a_late_report_of_a_tour_that_is_over_serves_what_is_open_again() {
    let bench = Bench::new().await;
    let request = bench.submit("s1").await;
    let tour = bench.tour("c", &["s1"]).await;
    let met = bench.clock.now();
    bench.advance(3 + 60 + 1_800);
    let after = Duration::from_secs(1_800);
    assert!(bench.store.writer.call(Overdue { tour_id: tour, after }).await.unwrap());
    // Even where the charger's clock is behind the receipt of the request.
    let met = Some(minus(met, Duration::from_secs(60)));
    let late =
        NewVisit { arrived_at: met, departed_at: met, ..report(tour, "s1", Outcome::Charged) };
    assert_eq!(bench.try_visit("late", late).await.unwrap().served, [request.id]);
    assert_eq!(bench.state(request.id).await, RequestState::Served);
}

#[tokio::test]
async fn a_report_of_one_tour_leaves_the_stop_of_another_alone() {
    let bench = Bench::new().await;
    let first = bench.tour("c", &[]).await;
    let request = bench.submit("s1").await;
    bench.tour("d", &["s1"]).await;
    assert!(bench.visit(first, "s1", Outcome::Charged).await.served.is_empty());
    assert_eq!(bench.state(request.id).await, RequestState::Planned);
}

#[tokio::test]
async fn a_report_keeps_a_tour_from_being_overdue() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let tour = bench.tour("c", &["s1"]).await;
    bench.advance(1_000);
    bench.visit(tour, "s1", Outcome::Skipped).await;
    let after = Duration::from_secs(1_800);
    bench.advance(1_799);
    assert!(!bench.store.writer.call(Overdue { tour_id: tour, after }).await.unwrap());
    bench.advance(1);
    assert!(bench.store.writer.call(Overdue { tour_id: tour, after }).await.unwrap());
}
