//! What tests start from: a fresh database, a clock that stands still, a small network.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tempfile::TempDir;
use voltour_solver::plan::Status;
use voltour_solver::scenario::Objective;

use super::{
    Announce, Batch, Cancel, CloseBatch, Closing, Complete, NewPlan, NewStop, Put, ReportVisit,
    Store, StoreError, StorePlan, Storing, Submit, TakeBack,
};
use crate::clock::{Clock, ManualClock, plus};
use crate::domain::{
    Announcement, Call, CancelDeparture, ChargerType, Departure, DepartureId, DepartureState,
    Network, NetworkSpec, NewRequest, NewVisit, Outcome, Place, PutNetwork, Refusal, Request,
    RequestId, RequestState, Sensor, Tour, TourId, Visit, Withdraw,
};

pub const LEAD: Duration = Duration::from_secs(3);
pub const MAX_LATE: Duration = Duration::from_secs(600);

/// Five sensors `s0` to `s4` in a row, one charger type.
pub fn spec() -> NetworkSpec {
    let sensor = |i: u32| Sensor {
        id: format!("s{i}").parse().unwrap(),
        place: Place::PositionM([f64::from(i) * 10.0, 0.0]),
        range_m: None,
        battery_j: 100.0,
        drain_w: Some(0.01),
    };
    NetworkSpec {
        objective: Objective::MaxCount,
        charge_level: None,
        coverage: None,
        charger_types: vec![ChargerType {
            name: "cart".into(),
            speed_mps: 5.0,
            travel_jpm: 1.0,
            transfer_w: 10.0,
            capacity_j: None,
            timespan_s: None,
            start_m: [0.0, 0.0],
            end_m: None,
        }],
        sensors: (0..5).map(sensor).collect(),
    }
}

pub fn call<T>(client_id: &str, content: T) -> Call<T> {
    Call { client_id: client_id.parse().unwrap(), content }
}

pub fn asks(sensor: &str) -> NewRequest {
    NewRequest {
        network_id: "net".parse().unwrap(),
        sensor_id: sensor.parse().unwrap(),
        place: None,
        deadline: None,
        ready: None,
        residual_j: Some(20.0),
        measured_at: None,
        drain_w: None,
        reward: None,
        required: false,
    }
}

pub fn leaves(charger: &str, t0: Option<Timestamp>) -> Announcement {
    Announcement {
        network_id: "net".parse().unwrap(),
        charger_id: charger.parse().unwrap(),
        charger_type: None,
        t0,
        start_m: None,
        end_m: None,
        capacity_j: None,
        timespan_s: None,
    }
}

/// A clock that stands still at the beginning of a year.
pub fn standing() -> Arc<ManualClock> {
    Arc::new(ManualClock::new("2026-01-01T00:00:00Z".parse().unwrap()))
}

/// A store on a fresh database.
pub struct Bench {
    pub dir: TempDir,
    pub clock: Arc<ManualClock>,
    pub store: Store,
    calls: std::sync::atomic::AtomicU32,
}

impl Bench {
    /// With the network `net` of [`spec`].
    pub async fn new() -> Self {
        let bench = Self::over(tempfile::tempdir().unwrap(), standing()).await.unwrap();
        bench.put(spec()).await;
        bench
    }

    /// On the database in a folder, or on a new one.
    pub async fn over(dir: TempDir, clock: Arc<ManualClock>) -> Result<Self, StoreError> {
        let store = Store::open(&dir.path().join("db"), clock.clone()).await?;
        Ok(Self { dir, clock, store, calls: 0.into() })
    }

    /// Stops the service and starts it again.
    pub async fn reopened(self) -> Self {
        let Self { dir, clock, store, calls } = self;
        store.task.stop.cancel();
        store.task.ended.await.unwrap().unwrap();
        let store = Store::open(&dir.path().join("db"), clock.clone()).await.unwrap();
        Self { dir, clock, store, calls }
    }

    /// The writer ends in the middle of its work; then the service starts again.
    pub async fn crashed(self) -> Self {
        let Self { dir, clock, store, calls } = self;
        let Store { task, .. } = store;
        task.ended.abort();
        // Its end is the abortion.
        let _ = task.ended.await;
        let store = Store::open(&dir.path().join("db"), clock.clone()).await.unwrap();
        Self { dir, clock, store, calls }
    }

    /// The database file.
    pub fn path(&self) -> std::path::PathBuf {
        self.dir.path().join("db")
    }

    /// No id of a call is one that an earlier bench on the same database has used.
    pub fn skip_calls(&self) {
        self.calls.store(1_000_000, std::sync::atomic::Ordering::Relaxed);
    }

    /// To start a scheduler on.
    pub fn parts(self) -> (TempDir, Arc<ManualClock>, Store) {
        (self.dir, self.clock, self.store)
    }

    /// A client id that was not used before.
    pub fn fresh(&self) -> String {
        format!("call-{}", self.calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
    }

    pub fn later(&self, seconds: u64) -> Timestamp {
        plus(self.clock.now(), Duration::from_secs(seconds))
    }

    pub fn advance(&self, seconds: u64) {
        self.clock.advance(Duration::from_secs(seconds));
    }

    pub async fn put(&self, spec: NetworkSpec) -> Network {
        self.try_put(spec).await.unwrap()
    }

    pub async fn try_put(&self, spec: NetworkSpec) -> Result<Network, Refusal> {
        let content =
            PutNetwork { network_id: "net".parse().unwrap(), spec, expected_version: None };
        self.store.writer.call(Put::new(call(&self.fresh(), content), 1_000).unwrap()).await
    }

    pub async fn try_submit(&self, id: &str, asked: NewRequest) -> Result<Request, Refusal> {
        self.store.writer.call(Submit::new(call(id, asked))).await
    }

    pub async fn submit(&self, sensor: &str) -> Request {
        self.try_submit(&self.fresh(), asks(sensor)).await.unwrap()
    }

    /// With a deadline so many seconds from now.
    pub async fn submit_until(&self, sensor: &str, seconds: u64) -> Request {
        let asked = NewRequest { deadline: Some(self.later(seconds)), ..asks(sensor) };
        self.try_submit(&self.fresh(), asked).await.unwrap()
    }

    pub async fn withdraw(&self, id: RequestId) -> Result<Request, Refusal> {
        let content = Withdraw { network_id: "net".parse().unwrap(), request_id: id };
        self.store.writer.call(TakeBack(call(&self.fresh(), content))).await
    }

    pub async fn try_announce(&self, id: &str, what: Announcement) -> Result<Departure, Refusal> {
        self.store.writer.call(Announce { call: call(id, what), lead: LEAD, most: 1_000 }).await
    }

    /// As soon as can be.
    pub async fn announce(&self, charger: &str) -> DepartureId {
        self.try_announce(&self.fresh(), leaves(charger, None)).await.unwrap().id
    }

    pub async fn close(&self, id: DepartureId) -> Closing {
        self.try_close(id).await.unwrap()
    }

    pub async fn try_close(&self, id: DepartureId) -> Result<Closing, Refusal> {
        let close = CloseBatch { departure_id: id, lead: LEAD, max_late: MAX_LATE };
        self.store.writer.call(close).await
    }

    pub async fn closed(&self, id: DepartureId) -> Batch {
        match self.close(id).await {
            Closing::Closed(batch) => *batch,
            other => panic!("{other:?}"),
        }
    }

    /// Stores a plan of a batch whose stops are these sensors.
    pub async fn store_plan(&self, batch: &Batch, stops: &[&str]) -> Result<Storing, Refusal> {
        let stop = |sensor: &&str| {
            let request = batch.requests.iter().find(|r| r.asked.sensor_id.as_str() == *sensor);
            let request = request.unwrap();
            NewStop {
                request_id: request.id,
                sensor_id: request.asked.sensor_id.clone(),
                position_m: [1.0, 2.0],
                arrive: batch.start,
                depart: batch.start,
                charge_j: 1.0,
            }
        };
        let plan = NewPlan {
            status: Status::Feasible,
            solver: "greedy".into(),
            objective: 1.0,
            bound: None,
            distance_m: 1.0,
            travel_j: 1.0,
            charge_j: 1.0,
            start_m: [0.0, 0.0],
            end_m: [0.0, 0.0],
            finish: plus(batch.start, Duration::from_secs(60)),
            stops: stops.iter().map(stop).collect(),
            unserved: 0,
            envelope: super::pack(b"{}").unwrap(),
            scenario: super::pack(b"{}").unwrap(),
        };
        let (departure_id, start) = (batch.departure.id, batch.start);
        self.store.writer.call(StorePlan { departure_id, start, plan }).await
    }

    /// Announces, closes and plans a departure with these stops.
    pub async fn tour(&self, charger: &str, stops: &[&str]) -> TourId {
        let id = self.announce(charger).await;
        let batch = self.closed(id).await;
        match self.store_plan(&batch, stops).await {
            Ok(Storing::Stored(tour)) => tour,
            other => panic!("{other:?}"),
        }
    }

    pub async fn visit(&self, tour: TourId, sensor: &str, outcome: Outcome) -> Visit {
        self.try_visit(&self.fresh(), report(tour, sensor, outcome)).await.unwrap()
    }

    pub async fn try_visit(&self, id: &str, visit: NewVisit) -> Result<Visit, Refusal> {
        self.store.writer.call(ReportVisit(call(id, visit))).await
    }

    pub async fn complete(&self, tour: TourId) -> Result<Tour, Refusal> {
        self.store.writer.call(Complete(call(&self.fresh(), tour))).await
    }

    pub async fn cancel(&self, id: DepartureId) -> Result<Departure, Refusal> {
        let content = CancelDeparture { departure_id: id, reason: "rain".into() };
        self.store.writer.call(Cancel(call(&self.fresh(), content))).await
    }

    pub async fn state(&self, id: RequestId) -> RequestState {
        self.store.reads.request(id).await.unwrap().unwrap().state
    }

    pub async fn departure_state(&self, id: DepartureId) -> DepartureState {
        self.store.reads.departure(id).await.unwrap().unwrap().state
    }
}

pub fn report(tour: TourId, sensor: &str, outcome: Outcome) -> NewVisit {
    NewVisit {
        tour_id: tour,
        sensor_id: sensor.parse().unwrap(),
        outcome,
        arrived_at: None,
        departed_at: None,
        charge_j: Some(5.0),
        note: None,
    }
}
