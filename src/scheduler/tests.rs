//! The scheduler as it runs: the clock is set, and what is due happens.

use std::sync::{Arc, Once};
use std::time::Duration;

use jiff::Timestamp;
use tokio::sync::Semaphore;
use tokio::time::timeout;
use tokio_util::sync::CancellationToken;

use super::departing::Departing;
use super::{Handle, Running, Settings, start};
use crate::clock::{Clock, ManualClock, Sleep, plus, seconds};
use crate::domain::{
    ChargerId, Departure, DepartureId, DepartureState, NetworkId, Refusal, RequestState, Tour,
    TourState,
};
use crate::metrics::Metrics;
use crate::policy::{Policies, Shelf};
use crate::store::Store;
use crate::store::fixture::{Bench, asks, call, leaves};

mod clock;

/// A running scheduler whose searches end at once.
struct Service {
    _dir: tempfile::TempDir,
    clock: Arc<ManualClock>,
    handle: Handle,
    running: Running,
    cancel: CancellationToken,
}

async fn run(bench: Bench) -> Service {
    let (dir, clock, store) = bench.parts();
    started(dir, clock, store).await
}

async fn started(dir: tempfile::TempDir, clock: Arc<ManualClock>, store: Store) -> Service {
    let settings = Settings { budget: Duration::ZERO, ..Settings::default() };
    let (policies, cancel) = (Shelf::of(Policies::none()), CancellationToken::new());
    let starting =
        start(store, clock.clone(), settings, policies, Metrics::default(), cancel.clone());
    let (handle, running) = starting.await.unwrap();
    Service { _dir: dir, clock, handle, running, cancel }
}

impl Service {
    async fn restarted(self) -> Self {
        let Self { _dir: dir, clock, running, cancel, .. } = self;
        cancel.cancel();
        running.finished().await.unwrap();
        let store = Store::open(&dir.path().join("db"), clock.clone()).await.unwrap();
        started(dir, clock, store).await
    }

    async fn announce(&self, id: &str, charger: &str, in_s: Option<u64>) -> Departure {
        let t0 = in_s.map(|s| plus(self.clock.now(), Duration::from_secs(s)));
        self.handle.announce(call(id, leaves(charger, t0))).await.unwrap()
    }

    async fn next(&self, charger: &str) -> Result<Tour, Refusal> {
        self.next_of(charger, None).await
    }

    async fn next_of(&self, charger: &str, of: Option<DepartureId>) -> Result<Tour, Refusal> {
        let (network, charger): (NetworkId, ChargerId) = (net(), charger.parse().unwrap());
        let wait = self.handle.next_tour(&network, &charger, of);
        timeout(Duration::from_secs(20), wait).await.unwrap()
    }

    fn advance(&self, seconds: u64) {
        self.clock.advance(Duration::from_secs(seconds));
    }

    /// Waits until a departure is in a state.
    async fn until(&self, id: DepartureId, state: DepartureState) -> Departure {
        let mut changes = self.handle.changes();
        let reached = async {
            loop {
                let departure = self.handle.reads().departure(id).await.unwrap().unwrap();
                if departure.state == state {
                    return departure;
                }
                changes.changed().await.unwrap();
            }
        };
        timeout(Duration::from_secs(20), reached).await.unwrap()
    }
}

fn net() -> NetworkId {
    "net".parse().unwrap()
}

#[tokio::test]
async fn a_departure_is_closed_a_lead_before_t0_and_its_tour_handed_out_until_it_is_complete() {
    let service = run(Bench::new().await).await;
    let request = service.handle.submit(call("r", asks("s1"))).await.unwrap();
    let departure = service.announce("a", "c", Some(60)).await;
    service.advance(56);
    tokio::time::sleep(Duration::from_millis(50)).await;
    let waiting = service.handle.reads().departure(departure.id).await.unwrap().unwrap();
    assert_eq!(waiting.state, DepartureState::Announced);
    service.advance(1);
    let tour = service.next("c").await.unwrap();
    assert_eq!((tour.start, tour.stops.len()), (departure.t0, 1));
    assert_eq!(tour.stops[0].request_id, request.id);
    assert_eq!(service.next("c").await.unwrap(), tour);
    let completed = service.handle.complete(call("z", tour.id)).await.unwrap();
    assert_eq!(completed.state, TourState::Completed);
    let none = service.next("c").await;
    assert!(matches!(none, Err(Refusal::FailedPrecondition(_))), "{none:?}");
    let over = service.next_of("c", Some(departure.id)).await.unwrap();
    assert_eq!(over, completed);
    let other = service.next_of("d", Some(departure.id)).await;
    assert!(matches!(other, Err(Refusal::NotFound { .. })), "{other:?}");
}

#[tokio::test]
async fn whoever_waits_hears_of_the_plan_and_of_the_cancellation() {
    let service = run(Bench::new().await).await;
    let planned = service.announce("a", "c", Some(60)).await;
    let cancelled = service.announce("b", "d", Some(600)).await;
    let (tour, none, ()) = tokio::join!(service.next("c"), service.next("d"), async {
        tokio::time::sleep(Duration::from_millis(50)).await;
        service.advance(57);
        let content = crate::domain::CancelDeparture {
            departure_id: cancelled.id,
            reason: "flat tyre".into(),
        };
        service.handle.cancel(call("x", content)).await.unwrap();
    });
    assert_eq!(tour.unwrap().departure_id, planned.id);
    assert!(none.unwrap_err().to_string().contains("flat tyre"));
}

#[tokio::test]
async fn departures_of_a_network_go_in_the_order_of_t0_and_id() {
    let service = run(Bench::new().await).await;
    let last = service.announce("a", "c1", Some(62)).await;
    let first = service.announce("b", "c2", Some(61)).await;
    let second = service.announce("d", "c3", Some(61)).await;
    service.advance(60);
    let mut changes = Vec::new();
    for departure in [first.id, second.id, last.id] {
        changes.push(service.until(departure, DepartureState::Planned).await.change);
    }
    assert!(changes.windows(2).all(|pair| pair[0] < pair[1]), "{changes:?}");
}

#[tokio::test]
async fn the_next_departure_of_a_charger_waits_for_its_tour_and_others_do_not() {
    let service = run(Bench::new().await).await;
    service.announce("a", "c", None).await;
    let tour = service.next("c").await.unwrap();
    let blocked = service.announce("b", "c", None).await;
    let other = service.announce("d", "other", None).await;
    service.until(other.id, DepartureState::Planned).await;
    service.handle.complete(call("z", tour.id)).await.unwrap();
    service.until(blocked.id, DepartureState::Planned).await;
    // One that waits for too long is missed while the tour is still out.
    let missed = service.announce("e", "c", None).await;
    service.advance(601);
    service.until(missed.id, DepartureState::Missed).await;
}

#[tokio::test]
async fn silence_makes_a_tour_overdue() {
    let service = run(Bench::new().await).await;
    let request = service.handle.submit(call("r", asks("s1"))).await.unwrap();
    let departure = service.announce("a", "c", None).await;
    let tour = service.next("c").await.unwrap();
    service.clock.set(plus(tour.finish, Duration::from_secs(1_800)));
    service.until(departure.id, DepartureState::Overdue).await;
    let request = service.handle.reads().request(request.id).await.unwrap().unwrap();
    assert_eq!(request.state, RequestState::Open);
}

#[tokio::test]
async fn a_departure_that_was_closed_is_planned_after_a_restart() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let departure = bench.announce("c").await;
    bench.closed(departure).await;
    bench.advance(200);
    let service = run(bench).await;
    let tour = service.next("c").await.unwrap();
    assert_eq!(tour.start, plus(service.clock.now(), Duration::from_secs(3)));
    assert_eq!(tour.stops.len(), 1);
    let service = service.restarted().await;
    assert_eq!(service.next("c").await.unwrap(), tour);
}

#[tokio::test]
async fn too_late_after_a_restart_is_missed() {
    let bench = Bench::new().await;
    let departure = bench.announce("c").await;
    bench.advance(700);
    let service = run(bench).await;
    let missed = service.until(departure, DepartureState::Missed).await;
    assert!(missed.reason.is_some());
}

#[tokio::test]
async fn the_end_refuses_and_ends_whoever_waits() {
    let service = run(Bench::new().await).await;
    service.announce("a", "c", Some(600)).await;
    let (waited, ()) = tokio::join!(service.next("c"), async {
        tokio::time::sleep(Duration::from_millis(50)).await;
        service.cancel.cancel();
    });
    assert!(matches!(waited, Err(Refusal::Unavailable(_))), "{waited:?}");
    service.running.finished().await.unwrap();
    let late = service.handle.submit(call("r", asks("s1"))).await;
    assert!(matches!(late, Err(Refusal::Unavailable(_))), "{late:?}");
}

/// A clock on which a second passes with every look of the planner.
#[derive(Debug)]
struct Slow(Arc<ManualClock>);

impl Clock for Slow {
    fn now(&self) -> Timestamp {
        self.0.advance(Duration::from_secs(1));
        self.0.now()
    }

    fn ran(&self) -> Duration {
        self.0.advance(Duration::from_secs(1));
        self.0.ran()
    }

    fn sleep_until(&self, time: Timestamp) -> Sleep<'_> {
        self.0.sleep_until(time)
    }

    fn pause(&self, length: Duration) -> Sleep<'_> {
        self.0.pause(length)
    }
}

/// A clock that is set on, once, while the planner measures how long it takes, which is no time at all.
#[derive(Debug)]
struct SetOn(Arc<ManualClock>, Once);

impl Clock for SetOn {
    fn now(&self) -> Timestamp {
        self.0.now()
    }

    fn ran(&self) -> Duration {
        self.1.call_once(|| self.0.set(plus(self.0.now(), Duration::from_secs(100))));
        self.0.ran()
    }

    fn sleep_until(&self, time: Timestamp) -> Sleep<'_> {
        self.0.sleep_until(time)
    }

    fn pause(&self, length: Duration) -> Sleep<'_> {
        self.0.pause(length)
    }
}

/// The lead, in seconds, with which a departure was planned, by a clock made of that of the store.
async fn lead_s<C: Clock>(of: impl FnOnce(Arc<ManualClock>) -> C) -> f64 {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let id = bench.announce("c").await;
    let (_dir, clock, store) = bench.parts();
    let departing = Departing {
        writer: store.writer.clone(),
        reads: store.reads.clone(),
        clock: Arc::new(of(clock.clone())),
        settings: Settings { budget: Duration::ZERO, ..Settings::default() },
        policies: Shelf::of(Policies::none()),
        metrics: Metrics::default(),
        planners: Arc::new(Semaphore::new(1)),
        cancel: CancellationToken::new(),
    };
    timeout(Duration::from_secs(20), departing.depart(id)).await.unwrap().unwrap();
    let departure = store.reads.departure(id).await.unwrap().unwrap();
    assert_eq!(departure.state, DepartureState::Planned);
    // Second 0 had not passed when the plan was stored.
    assert!(departure.start.unwrap() >= clock.now());
    seconds(departure.closes_at, departure.start.unwrap())
}

#[tokio::test]
async fn a_plan_that_comes_late_is_made_again_with_the_lead_that_it_took() {
    let lead_s = lead_s(Slow).await;
    assert!(lead_s > Settings::default().lead.as_secs_f64(), "{lead_s}");
}

#[tokio::test]
async fn a_clock_that_is_set_while_a_plan_is_made_is_no_time_that_it_took() {
    let lead_s = lead_s(|clock| SetOn(clock, Once::new())).await;
    assert_eq!(lead_s, 2.0 * Settings::default().lead.as_secs_f64(), "it was late, and quick");
}
