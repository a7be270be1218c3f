//! From a batch to a plan that holds: what the scenario says of it, and what is stored.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use jiff::Timestamp;
use tokio_util::sync::CancellationToken;
use voltour_solver::check::check;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{SolverName, solve};

use super::scenario::scenario;
use super::{Contest, plan};
use crate::clock::{Clock, Sleep, minus, plus};
use crate::domain::{Announcement, Coverage, NewRequest, Place, TimedPoint};
use crate::policy::tests::zeros;
use crate::store::fixture::{Bench, asks, leaves, spec};
use crate::store::{Batch, NewPlan};

/// A clock on which a millisecond passes with every look: a budget is a number of iterations.
#[derive(Debug)]
struct Ticking(Mutex<Timestamp>);

impl Clock for Ticking {
    fn now(&self) -> Timestamp {
        let mut now = self.0.lock().unwrap();
        *now = plus(*now, Duration::from_millis(1));
        *now
    }

    fn ran(&self) -> Duration {
        Duration::try_from(self.0.lock().unwrap().as_duration()).unwrap()
    }

    fn sleep_until(&self, _: Timestamp) -> Sleep<'_> {
        Box::pin(std::future::pending())
    }

    fn pause(&self, _: Duration) -> Sleep<'_> {
        Box::pin(std::future::pending())
    }
}

pub(super) fn contest(bench: &Bench, solver: SolverName) -> Contest {
    let clock = Arc::new(Ticking(Mutex::new(bench.clock.now())));
    let (budget, latest) = (Duration::from_secs(1), bench.later(2));
    let policies = zeros().into();
    Contest {
        solver,
        solve,
        policies,
        seed: 7,
        budget,
        latest,
        clock,
        cancel: CancellationToken::new(),
    }
}

pub(super) fn unpacked(packed: &[u8]) -> serde_json::Value {
    serde_json::from_slice(&zstd::decode_all(packed).unwrap()).unwrap()
}

fn planned(bench: &Bench, batch: &Batch, solver: SolverName) -> NewPlan {
    let new = plan(batch, &contest(bench, solver)).unwrap().new;
    // What is stored is what the check accepted: documents of the format, no field more.
    let envelope = unpacked(&new.envelope);
    let plan = Plan::from_json(envelope["plan"].to_string().as_bytes()).unwrap();
    let document = zstd::decode_all(&new.scenario[..]).unwrap();
    assert_eq!(check(&Scenario::from_json(&document).unwrap(), &plan), []);
    new
}

pub(super) async fn closed(bench: &Bench) -> Batch {
    bench.closed(bench.announce("c").await).await
}

#[tokio::test]
async fn a_batch_becomes_a_plan_with_its_provenance() {
    let bench = Bench::new().await;
    let requests = [bench.submit("s1").await, bench.submit("s3").await];
    let batch = closed(&bench).await;
    let new = planned(&bench, &batch, SolverName::Auto);
    let stops: Vec<_> = new.stops.iter().map(|stop| stop.request_id).collect();
    assert!(requests.iter().all(|request| stops.contains(&request.id)), "{stops:?}");
    assert!(new.stops.iter().all(|stop| stop.arrive >= batch.start && stop.depart >= stop.arrive));
    assert!(new.finish > batch.start);
    let provenance = &unpacked(&new.envelope)["provenance"];
    assert_eq!(provenance["asked"], "auto");
    assert_eq!(provenance["seed"], 7);
    assert_eq!(provenance["check"], serde_json::json!(["holds"]));
    assert_eq!(provenance["batch"].as_array().unwrap().len(), 2);
    assert!(provenance["fallback_reason"].is_null());
    let contenders = provenance["contenders"].as_array().unwrap();
    let took = |contender: &serde_json::Value| contender["elapsed_s"].as_f64().unwrap();
    let names: Vec<_> = contenders.iter().map(|contender| &contender["solver"]).collect();
    assert_eq!(names, ["greedy", "dqn", "exact"]);
    assert!(contenders.iter().all(|contender| took(contender) >= 0.0), "{contenders:?}");
}

#[tokio::test]
async fn no_request_gives_the_empty_tour_by_the_same_path() {
    let bench = Bench::new().await;
    let new = planned(&bench, &closed(&bench).await, SolverName::Auto);
    assert!(new.stops.is_empty() && new.unserved == 0);
}

#[tokio::test]
async fn a_solver_that_fails_gives_way_to_the_next() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let new = planned(&bench, &closed(&bench).await, SolverName::Acs);
    assert_eq!((new.solver.as_str(), new.stops.len()), ("baseline", 1));
    let provenance = &unpacked(&new.envelope)["provenance"];
    assert!(provenance["fallback_reason"].as_str().unwrap().contains("acs"));
}

#[tokio::test]
async fn times_are_seconds_after_second_0_and_residuals_age() {
    let bench = Bench::new().await;
    let asked = NewRequest {
        deadline: Some(bench.later(103)),
        ready: Some(bench.later(1)),
        residual_j: Some(50.0),
        measured_at: Some(minus(bench.clock.now(), Duration::from_secs(7))),
        drain_w: Some(2.0),
        ..asks("s1")
    };
    bench.try_submit("a", asked).await.unwrap();
    bench.submit("s2").await;
    let empty = NewRequest { drain_w: Some(50.0), ..asks("s3") };
    bench.try_submit("c", empty).await.unwrap();
    let batch = closed(&bench).await;
    let (document, _) = scenario(&batch).unwrap();
    let of = |sensor: &str| document.requests.iter().find(|r| r.sensor == sensor).unwrap().clone();
    let first = of("s1");
    assert_eq!((first.deadline_s, first.ready_s), (Some(100.0), None));
    assert_eq!(first.residual_j, Some(50.0 - 2.0 * 10.0));
    // The registered consumption, and the receipt as the time of measuring.
    assert_eq!(of("s2").residual_j, Some(20.0 - 0.01 * 3.0));
    assert_eq!(of("s3").residual_j, Some(0.0));
    assert_eq!(document.sensors.len(), 5);
}

#[tokio::test]
async fn what_is_announced_stands_in_place_of_the_types() {
    let bench = Bench::new().await;
    let announced = Announcement {
        start_m: Some([1.0, 2.0]),
        capacity_j: Some(9.0),
        timespan_s: Some(0.5),
        ..leaves("c", None)
    };
    bench.submit("s4").await;
    let departure = bench.try_announce("x", announced).await.unwrap();
    let batch = bench.closed(departure.id).await;
    let (document, _) = scenario(&batch).unwrap();
    let charger = &document.charger;
    assert_eq!((charger.start_m, charger.end_m), ([1.0, 2.0], None));
    assert_eq!((charger.capacity_j, charger.timespan_s), (Some(9.0), Some(0.5)));
    assert!(planned(&bench, &batch, SolverName::Auto).stops.is_empty());
}

#[tokio::test]
async fn the_dead_are_left_out_and_places_are_the_newest() {
    let bench = Bench::new().await;
    bench.submit_until("s0", 1).await;
    let place = Some(Place::PositionM([7.0, 7.0]));
    bench.try_submit("x", NewRequest { place, ..asks("s1") }).await.unwrap();
    let mut batch = closed(&bench).await;
    let waypoint =
        TimedPoint { time: plus(batch.start, Duration::from_secs(9)), position_m: [3.0, 4.0] };
    for sensor in ["s1", "s2"] {
        batch.paths.insert(sensor.parse().unwrap(), vec![waypoint]);
    }
    let (document, _) = scenario(&batch).unwrap();
    let ids: Vec<&str> = document.sensors.iter().map(|sensor| sensor.id.as_str()).collect();
    assert_eq!(ids, ["s1", "s2", "s3", "s4"]);
    assert_eq!(document.sensors[0].position_m, Some([7.0, 7.0]));
    assert_eq!(document.sensors[1].trajectory, Some(vec![[9.0, 3.0, 4.0]]));
}

#[tokio::test]
async fn moving_sensors_stand_still_where_the_network_has_got_a_coverage_constraint() {
    let bench = Bench::new().await;
    let at = |second: u64, x: f64| TimedPoint { time: bench.later(second), position_m: [x, 0.0] };
    let place = Some(Place::Trajectory(vec![at(1, 10.0), at(5, 18.0)]));
    bench.try_submit("x", NewRequest { place, ..asks("s1") }).await.unwrap();
    let mut covered = spec();
    let field_m = vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]];
    covered.coverage = Some(Coverage { k: 1, field_m });
    covered.sensors.iter_mut().for_each(|sensor| sensor.range_m = Some(50.0));
    bench.put(covered).await;
    let (document, _) = scenario(&closed(&bench).await).unwrap();
    // Second 0 is 3 s from now, half way.
    assert_eq!(document.sensors[1].position_m, Some([14.0, 0.0]));
}

#[tokio::test]
async fn the_epoch_is_no_special_time() {
    let bench = Bench::new().await;
    bench.clock.set(Timestamp::UNIX_EPOCH);
    bench.submit("s1").await;
    assert_eq!(planned(&bench, &closed(&bench).await, SolverName::Auto).stops.len(), 1);
}
