//! Retention at random moments of random histories.

use std::time::Duration;

use jiff::Timestamp;
use proptest::prelude::*;

use crate::clock::{Clock, minus, plus};
use crate::domain::{
    Announcement, DepartureId, DepartureState, NewRequest, Outcome, Refusal, Request, RequestId,
    RequestState, TourId,
};
use crate::store::fixture::{Bench, asks, leaves};
use crate::store::{Closing, DepartureFilter, Forget, Page, RequestFilter, Storing};

const DAY: Duration = Duration::from_secs(86_400);
const WEEK: Duration = Duration::from_secs(7 * 86_400);

#[derive(Clone, Debug)]
enum Event {
    Submit(u8),
    Withdraw,
    Depart(u8, usize),
    Visit(u8),
    End(bool),
    Pass(u8),
    Forget,
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        5 => (0u8..5).prop_map(Event::Submit),
        1 => Just(Event::Withdraw),
        3 => (0u8..3, 0usize..4).prop_map(|(charger, stops)| Event::Depart(charger, stops)),
        2 => (0u8..5).prop_map(Event::Visit),
        2 => any::<bool>().prop_map(Event::End),
        3 => (1u8..9).prop_map(Event::Pass),
        3 => Just(Event::Forget),
    ]
}

/// What a call has made.
struct Made<C, I> {
    client_id: String,
    content: C,
    id: I,
    /// Up to what it was deleted with.
    gone: Option<Timestamp>,
}

impl<C, I> Made<C, I> {
    fn by(client_id: String, content: C, id: I) -> Self {
        Self { client_id, content, id, gone: None }
    }

    /// Whether its call must be remembered, now that what ended before a time is deleted.
    fn is_remembered(&mut self, is_there: bool, before: Timestamp) -> bool {
        if is_there {
            return true;
        }
        let gone = *self.gone.get_or_insert(before);
        before <= plus(gone, WEEK)
    }
}

#[derive(Default)]
struct Story {
    submitted: Vec<Made<NewRequest, RequestId>>,
    announced: Vec<Made<Announcement, DepartureId>>,
    out: Vec<TourId>,
}

impl Story {
    async fn go_on(&mut self, bench: &Bench, event: Event) {
        match event {
            Event::Submit(sensor) => {
                let (id, asked) = (bench.fresh(), asks(&format!("s{sensor}")));
                let request = bench.try_submit(&id, asked.clone()).await.unwrap();
                self.submitted.push(Made::by(id, asked, request.id));
            }
            Event::Withdraw => {
                if let Some(Made { id, .. }) = self.submitted.last() {
                    // It may be over, or deleted.
                    let _ = bench.withdraw(*id).await;
                }
            }
            Event::Depart(charger, stops) => self.depart(bench, charger, stops).await,
            Event::Visit(sensor) => {
                if let Some(tour) = self.out.last() {
                    bench.visit(*tour, &format!("s{sensor}"), Outcome::Charged).await;
                }
            }
            Event::End(first) => {
                if !self.out.is_empty() {
                    let which = if first { 0 } else { self.out.len() - 1 };
                    bench.complete(self.out.remove(which)).await.unwrap();
                }
            }
            Event::Pass(days) => bench.clock.advance(u32::from(days) * DAY),
            Event::Forget => self.forget(bench).await,
        }
    }

    async fn depart(&mut self, bench: &Bench, charger: u8, stops: usize) {
        let (call, leaves) = (bench.fresh(), leaves(&format!("c{charger}"), None));
        let id = bench.try_announce(&call, leaves.clone()).await.unwrap().id;
        self.announced.push(Made::by(call, leaves, id));
        let batch = match bench.close(id).await {
            Closing::Closed(batch) => batch,
            Closing::ChargerOut => {
                bench.cancel(id).await.unwrap();
                return;
            }
            other => panic!("{other:?}"),
        };
        let sensors: Vec<&str> =
            batch.requests.iter().map(|r| r.asked.sensor_id.as_str()).take(stops).collect();
        match bench.store_plan(&batch, &sensors).await.unwrap() {
            Storing::Stored(tour) => self.out.push(tour),
            other => panic!("{other:?}"),
        }
    }

    /// Nothing that is not over is touched, nor anything that ended within the history.
    async fn forget(&mut self, bench: &Bench) {
        let net = "net".parse().unwrap();
        let before = minus(bench.clock.now(), WEEK);
        let reads = &bench.store.reads;
        let (requests, departures, tours) = (
            reads.live_requests(&net).await.unwrap().0,
            reads.live_departures(&net).await.unwrap().0,
            reads.live_tours(&net).await.unwrap().0,
        );
        let all: Vec<Request> = listed(bench).await;
        let last = *bench.store.writer.changes().borrow();
        bench.store.writer.call(Forget { before }).await.unwrap();
        assert_eq!(reads.live_requests(&net).await.unwrap().0, requests);
        assert_eq!(reads.live_departures(&net).await.unwrap().0, departures);
        assert_eq!(reads.live_tours(&net).await.unwrap().0, tours);
        let left = listed(bench).await;
        for request in &all {
            let is_left = left.contains(request);
            assert!(is_left || request.updated_at < before, "too soon: {request:?}");
        }
        let orphans = sqlx::query("PRAGMA foreign_key_check").fetch_all(reads.pool()).await;
        assert!(orphans.unwrap().is_empty());
        // A call that is repeated gets its answer for as long as what it made is there, and a week longer.
        for made in &mut self.submitted {
            let is_there = left.iter().any(|request| request.id == made.id);
            if made.is_remembered(is_there, before) {
                let again = bench.try_submit(&made.client_id, made.content.clone()).await.unwrap();
                assert_eq!(again.id, made.id);
            }
        }
        for made in &mut self.announced {
            let is_there = reads.departure(made.id).await.unwrap().is_some();
            if made.is_remembered(is_there, before) {
                let again = bench.try_announce(&made.client_id, made.content.clone()).await;
                assert_eq!(again.unwrap().id, made.id);
            }
        }
        assert_eq!(*bench.store.writer.changes().borrow(), last, "a repeated call stores nothing");
    }
}

async fn listed(bench: &Bench) -> Vec<Request> {
    let page = Page { limit: Page::LARGEST, after: None };
    bench.store.reads.requests(&RequestFilter::default(), &page).await.unwrap().items
}

async fn lives_through(events: Vec<Event>) {
    let bench = Bench::new().await;
    let mut story = Story::default();
    for event in events {
        story.go_on(&bench, event).await;
    }
    // The numbers of changes go on, whatever was deleted.
    let last = *bench.store.writer.changes().borrow();
    let bench = bench.reopened().await;
    assert_eq!(*bench.store.writer.changes().borrow(), last);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn what_is_not_over_is_never_touched(events in prop::collection::vec(event(), 1..60)) {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        runtime.unwrap().block_on(lives_through(events));
    }
}

#[tokio::test]
async fn what_is_over_goes_with_all_that_hangs_on_it_and_pages_go_on() {
    let bench = Bench::new().await;
    let mut ended = Vec::new();
    for _ in 0..3 {
        let request = bench.submit("s1").await;
        let tour = bench.tour("c", &["s1"]).await;
        bench.visit(tour, "s1", Outcome::Charged).await;
        bench.complete(tour).await.unwrap();
        ended.push((request.id, tour));
    }
    let page = Page { limit: 1, after: None };
    let departures = DepartureFilter::default();
    let first = bench.store.reads.departures(&departures, &page).await.unwrap();
    bench.clock.advance(20 * DAY);
    let forget = Forget { before: minus(bench.clock.now(), WEEK) };
    let gone = bench.store.writer.call(forget).await.unwrap();
    assert_eq!((gone.departures, gone.requests, gone.calls), (2, 2, 2), "the last of all stays");
    let again = bench.store.writer.call(forget).await.unwrap();
    assert_eq!(again, crate::store::Forgotten::default());
    let (request, tour) = ended[0];
    assert_eq!(bench.store.reads.request(request).await.unwrap(), None);
    assert_eq!(bench.store.reads.tour(tour).await.unwrap(), None);
    let next = Page { limit: 1, after: first.next };
    assert!(bench.store.reads.departures(&departures, &next).await.unwrap().items.is_empty());
    for table in ["plans", "tours", "stops", "visits", "calls"] {
        let sql = sqlx::AssertSqlSafe(format!("SELECT count(*) FROM {table} WHERE 1 = 1"));
        let left: i64 = sqlx::query_scalar(sql).fetch_one(bench.store.reads.pool()).await.unwrap();
        // The call that put the network, that which completed the last tour, and those that made what is deleted.
        assert_eq!(left, if table == "calls" { 6 } else { 1 }, "{table}");
    }
}

#[tokio::test]
async fn a_call_is_remembered_a_week_longer_than_what_it_made() {
    let bench = Bench::new().await;
    let first = bench.try_submit("x", asks("s1")).await.unwrap();
    let superseding = bench.submit("s1").await;
    let departure = bench.try_announce("y", leaves("c", None)).await.unwrap();
    bench.cancel(departure.id).await.unwrap();
    bench.cancel(bench.announce("c").await).await.unwrap();
    bench.submit("s2").await;
    bench.clock.advance(30 * DAY);
    let forget = Forget { before: minus(bench.clock.now(), WEEK) };
    let gone = bench.store.writer.call(forget).await.unwrap();
    assert_eq!((gone.departures, gone.requests), (1, 1));
    let last = *bench.store.writer.changes().borrow();

    let again = bench.try_submit("x", asks("s1")).await.unwrap();
    assert_eq!((again.id, again.state), (first.id, RequestState::Superseded), "as it ended");
    assert_eq!(bench.state(superseding.id).await, RequestState::Open, "nothing newer came");
    let again = bench.try_announce("y", leaves("c", None)).await.unwrap();
    assert_eq!((again.id, again.state), (departure.id, DepartureState::Cancelled));
    for other in [
        bench.try_submit("x", asks("s2")).await.map(|_| ()),
        bench.try_announce("y", leaves("d", None)).await.map(|_| ()),
    ] {
        assert!(matches!(other, Err(Refusal::AlreadyExists { .. })), "{other:?}");
    }
    let week = Forget { before: plus(forget.before, WEEK) };
    bench.store.writer.call(week).await.unwrap();
    assert_eq!(bench.try_submit("x", asks("s1")).await.unwrap().id, first.id);
    assert_eq!(*bench.store.writer.changes().borrow(), last, "nothing was stored");

    let later = Forget { before: plus(week.before, Duration::from_secs(1)) };
    assert_eq!(bench.store.writer.call(later).await.unwrap().calls, 2);
    assert_ne!(bench.try_submit("x", asks("s1")).await.unwrap().id, first.id);
}
