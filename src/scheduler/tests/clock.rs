//! A wall clock that is set while the service runs, by an hour or by a day, forward or back.

use std::collections::HashSet;

use proptest::prelude::*;

use super::*;
use crate::domain::{NewRequest, RequestId};

const HOUR: Duration = Duration::from_secs(3_600);
const DAY: Duration = Duration::from_secs(86_400);

impl Service {
    async fn state(&self, id: RequestId) -> RequestState {
        self.handle.reads().request(id).await.unwrap().unwrap().state
    }

    /// With a deadline so many seconds from now.
    async fn submit_until(&self, id: &str, sensor: &str, seconds: u64) -> RequestId {
        let deadline = Some(plus(self.clock.now(), Duration::from_secs(seconds)));
        let asked = NewRequest { deadline, ..asks(sensor) };
        self.handle.submit(call(id, asked)).await.unwrap().id
    }
}

#[tokio::test]
async fn a_clock_that_is_set_back_delays_what_is_announced_and_loses_nothing() {
    let service = run(Bench::new().await).await;
    let before = service.submit_until("r", "s1", 7_200).await;
    let departure = service.announce("a", "c", Some(60)).await;
    service.clock.set(crate::clock::minus(service.clock.now(), HOUR));
    let after = service.submit_until("q", "s2", 7_200).await;
    assert!(after > before, "ids rise");
    service.advance(60);
    tokio::time::sleep(Duration::from_millis(50)).await;
    let waiting = service.handle.reads().departure(departure.id).await.unwrap().unwrap();
    assert_eq!(waiting.state, DepartureState::Announced, "t0 is a time, and has not come");
    service.advance(3_597);
    let tour = service.next("c").await.unwrap();
    assert_eq!((tour.start, tour.stops.len()), (departure.t0, 2));
    let service = service.restarted().await;
    service.clock.set(crate::clock::minus(service.clock.now(), DAY));
    assert_eq!(service.next("c").await.unwrap(), tour, "planned once");
    let late = service.submit_until("p", "s3", 60).await;
    assert!(late > after, "ids rise through a restart");
}

#[tokio::test]
async fn what_expired_under_a_clock_that_was_ahead_is_open_again() {
    let service = run(Bench::new().await).await;
    let (right, now) = (service.submit_until("r", "s1", 7_200).await, service.clock.now());
    let also = service.submit_until("q", "s2", 7_200).await;
    service.clock.set(plus(now, DAY));
    service.announce("a", "c", None).await;
    let tour = service.next("c").await.unwrap();
    assert_eq!((tour.stops.len(), service.state(right).await), (0, RequestState::Expired));
    service.handle.complete(call("z", tour.id)).await.unwrap();
    // One of the sensors asks again; the other's request is the one that it has.
    service.clock.set(now);
    let again = service.submit_until("q2", "s2", 7_200).await;
    service.announce("b", "c", None).await;
    let tour = service.next("c").await.unwrap();
    let planned: HashSet<RequestId> = tour.stops.iter().map(|stop| stop.request_id).collect();
    assert_eq!(planned, HashSet::from([right, again]));
    assert_eq!(service.state(also).await, RequestState::Expired);
}

#[tokio::test]
async fn what_expired_by_a_right_clock_stays_so() {
    let service = run(Bench::new().await).await;
    let late = service.submit_until("r", "s1", 60).await;
    service.advance(120);
    service.announce("a", "c", None).await;
    let tour = service.next("c").await.unwrap();
    service.handle.complete(call("z", tour.id)).await.unwrap();
    service.advance(60);
    service.announce("b", "c", None).await;
    assert!(service.next("c").await.unwrap().stops.is_empty());
    assert_eq!(service.state(late).await, RequestState::Expired);
}

#[derive(Clone, Debug)]
enum Event {
    Submit(u8),
    Announce(u8, u16),
    Pass(u16),
    Set(i32),
    Complete,
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        3 => (0u8..5).prop_map(Event::Submit),
        2 => (0u8..3, 0u16..400).prop_map(|(charger, s)| Event::Announce(charger, s)),
        3 => (0u16..400).prop_map(Event::Pass),
        2 => prop_oneof![Just(3_600), Just(-3_600), Just(86_400), Just(-86_400)]
            .prop_map(Event::Set),
        1 => Just(Event::Complete),
    ]
}

async fn lives_through(events: Vec<Event>) {
    let service = run(Bench::new().await).await;
    let (mut submitted, mut departures, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
    for (number, event) in events.into_iter().enumerate() {
        let id = format!("call-{number}");
        match event {
            Event::Submit(sensor) => {
                let sensor = format!("s{sensor}");
                submitted.push(service.submit_until(&id, &sensor, 5_000).await);
            }
            Event::Announce(charger, s) => {
                let charger = format!("c{charger}");
                let departure = service.announce(&id, &charger, Some(s.into())).await;
                departures.push(departure.id);
                let (handle, of) = (service.handle.clone(), Some(departure.id));
                let charger: ChargerId = charger.parse().unwrap();
                waiting.push(tokio::spawn(async move {
                    handle.next_tour(&net(), &charger, of).await.map(|tour| tour.departure_id)
                }));
            }
            Event::Pass(seconds) => service.advance(seconds.into()),
            Event::Set(by) => {
                let by = jiff::SignedDuration::from_secs(by.into());
                service.clock.set(service.clock.now().checked_add(by).unwrap());
            }
            Event::Complete => {
                let out = service.handle.reads().live_tours(&net()).await.unwrap().0;
                if let Some(tour) = out.first() {
                    // It may be overdue by now.
                    let _ = service.handle.complete(call(&id, tour.id)).await;
                }
            }
        }
        tokio::task::yield_now().await;
    }
    assert!(submitted.is_sorted(), "ids rise");
    assert_eq!(submitted.iter().collect::<HashSet<_>>().len(), submitted.len());
    for id in &submitted {
        assert!(service.handle.reads().request(*id).await.unwrap().is_some());
    }
    // Whatever was announced is planned, or too late, in the end; and so is whoever waits for it.
    service.clock.set(plus(service.clock.now(), 400 * DAY));
    for (id, waits) in departures.iter().zip(waiting) {
        let told = timeout(Duration::from_secs(20), waits).await.expect("it ends").unwrap();
        assert!(
            matches!(told, Ok(of) if of == *id)
                || matches!(told, Err(Refusal::FailedPrecondition(_)))
        );
    }
    let plans = service.handle.reads().plans(&Default::default(), &page()).await.unwrap().items;
    let planned: HashSet<DepartureId> = plans.iter().map(|plan| plan.departure_id).collect();
    assert_eq!(planned.len(), plans.len(), "no departure has two plans");
}

fn page() -> crate::store::Page {
    crate::store::Page { limit: crate::store::Page::LARGEST, after: None }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn wherever_the_clock_is_set_nothing_is_lost_and_nothing_waits_for_ever(
        events in prop::collection::vec(event(), 1..40),
    ) {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build();
        runtime.unwrap().block_on(lives_through(events));
    }
}
