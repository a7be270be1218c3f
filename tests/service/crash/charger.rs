//! A charger: a small machine that keeps each call until it is answered, and makes it again, under the
//! same client id, after a crash. It remembers what it was told.

use std::collections::HashMap;

use tonic::transport::Channel;
use tonic::{Code, Request, Status};
use voltour::proto::departure_service_client::DepartureServiceClient;
use voltour::proto::tour_service_client::TourServiceClient;
use voltour::proto::{
    AnnounceRequest, CancelDepartureRequest, CompleteRequest, Departure, GetNextRequest,
    ReportVisitRequest, Tour, Visit,
};

use super::aim::Killed;
use super::rng::Rng;
use crate::app::PATIENCE;
use crate::calls::soon;
use crate::field::FIELD;
use crate::time::{from_now, us};

/// The call that it is about to make.
#[derive(Clone, Debug)]
enum Stage {
    Announce(AnnounceRequest),
    Fetch(Departure),
    Report(Tour, Vec<ReportVisitRequest>),
    Complete(CompleteRequest),
    Cancel(CancelDepartureRequest, Tour),
}

#[derive(Debug)]
pub struct Charger {
    id: String,
    rng: Rng,
    calls: u64,
    stage: Stage,
    /// What it was told, by call.
    pub announced: Vec<Departure>,
    /// By departure.
    pub tours: HashMap<String, Tour>,
    pub visits: Vec<Visit>,
    /// Ids of the tours, and the state that they ended in.
    pub ended: Vec<(String, &'static str)>,
}

impl Charger {
    pub fn new(id: &str, seed: u64) -> Self {
        let id = format!("{id}{seed}");
        let mut charger = Self {
            rng: Rng::new(seed ^ u64::from(id.as_bytes()[0]) << 32),
            id,
            calls: 0,
            stage: Stage::Announce(AnnounceRequest::default()),
            announced: Vec::new(),
            tours: HashMap::new(),
            visits: Vec::new(),
            ended: Vec::new(),
        };
        charger.stage = charger.leave();
        charger
    }

    /// The tour that it is on, as far as it knows.
    pub fn on(&self) -> Option<&Tour> {
        match &self.stage {
            Stage::Report(tour, _) => Some(tour),
            _ => None,
        }
    }

    /// Works until the process is killed.
    pub async fn drive(
        &mut self,
        mut departures: DepartureServiceClient<Channel>,
        mut tours: TourServiceClient<Channel>,
        killed: &Killed,
    ) {
        while !killed.struck() {
            if let Err(status) = self.step(&mut departures, &mut tours, Some(killed)).await {
                let told = killed.struck() || status.code() == Code::DeadlineExceeded;
                assert!(told, "charger {} at {:?}: {status}", self.id, self.stage);
            }
        }
    }

    /// Ends the tour that it is on.
    pub async fn finish(
        &mut self,
        mut departures: DepartureServiceClient<Channel>,
        mut tours: TourServiceClient<Channel>,
    ) {
        while !matches!(self.stage, Stage::Announce(_)) {
            let step = self.step(&mut departures, &mut tours, None);
            soon("a charger's last calls", step).await.expect("no failure");
        }
        // The announcement itself may have been stored without an answer.
        for _ in 0..2 {
            let step = self.step(&mut departures, &mut tours, None);
            soon("the last announcement", step).await.expect("no failure");
        }
        while !matches!(self.stage, Stage::Announce(_)) {
            let step = self.step(&mut departures, &mut tours, None);
            soon("the last tour", step).await.expect("no failure");
        }
    }

    /// One call; the stage moves on only with its answer.
    async fn step(
        &mut self,
        departures: &mut DepartureServiceClient<Channel>,
        tours: &mut TourServiceClient<Channel>,
        killed: Option<&Killed>,
    ) -> Result<(), Status> {
        match self.stage.clone() {
            Stage::Announce(call) => {
                let departure = match departures.announce(call.clone()).await {
                    // Nobody took it before the service was away for longer than a t0 may be old.
                    Err(status) if is_too_old(&call) && status.code() == Code::InvalidArgument => {
                        self.stage = self.leave();
                        return Ok(());
                    }
                    answer => answer?.into_inner(),
                };
                assert_eq!(
                    departure.announced.as_ref().map(|a| &a.client_id),
                    Some(&call.client_id)
                );
                if let Some(killed) = killed {
                    killed.announced(us(&departure.closes_at));
                }
                self.announced.push(departure.clone());
                self.stage = Stage::Fetch(departure);
            }
            Stage::Fetch(departure) => {
                let mut next = Request::new(GetNextRequest {
                    network_id: FIELD.into(),
                    charger_id: self.id.clone(),
                    departure_id: departure.id.clone(),
                });
                next.set_timeout(PATIENCE);
                let tour = tours.get_next(next).await?.into_inner();
                if let Some(killed) = killed {
                    killed.fetched();
                }
                assert_eq!(tour.departure_id, departure.id);
                self.tours.insert(departure.id, tour.clone());
                let reports = self.reports(&tour);
                self.stage = Stage::Report(tour, reports);
            }
            Stage::Report(tour, mut reports) => match reports.last().cloned() {
                Some(call) => {
                    self.visits.push(tours.report_visit(call).await?.into_inner());
                    reports.pop();
                    self.stage = Stage::Report(tour, reports);
                }
                None => self.stage = self.end(tour),
            },
            Stage::Complete(call) => {
                let over = tours.complete(call).await?.into_inner();
                self.ended.push((over.id, "completed"));
                self.stage = self.leave();
            }
            Stage::Cancel(call, tour) => {
                departures.cancel(call).await?;
                self.ended.push((tour.id, "cancelled"));
                self.stage = self.leave();
            }
        }
        Ok(())
    }

    fn call(&mut self) -> String {
        self.calls += 1;
        format!("{}-{}", self.id, self.calls)
    }

    fn leave(&mut self) -> Stage {
        // As soon as can be, or a little later than that.
        let t0 = from_now(self.rng.range(310, 700) as i64).filter(|_| self.rng.one_in(3));
        Stage::Announce(AnnounceRequest {
            client_id: self.call(),
            network_id: FIELD.into(),
            charger_id: self.id.clone(),
            t0,
            ..AnnounceRequest::default()
        })
    }

    /// What it will report of a tour: most stops, in any order and outcome.
    fn reports(&mut self, tour: &Tour) -> Vec<ReportVisitRequest> {
        let mut reports = Vec::new();
        for stop in tour.stops.iter().take(12) {
            if self.rng.one_in(5) {
                continue;
            }
            reports.push(ReportVisitRequest {
                client_id: self.call(),
                tour_id: tour.id.clone(),
                sensor_id: stop.sensor_id.clone(),
                outcome: [1, 1, 2, 3][self.rng.range(0, 4) as usize],
                charge_j: Some(stop.charge_j),
                ..ReportVisitRequest::default()
            });
        }
        reports
    }

    fn end(&mut self, tour: Tour) -> Stage {
        let client_id = self.call();
        if self.rng.one_in(5) {
            let departure_id = tour.departure_id.clone();
            let call = CancelDepartureRequest { client_id, departure_id, reason: String::new() };
            Stage::Cancel(call, tour)
        } else {
            Stage::Complete(CompleteRequest { client_id, tour_id: tour.id })
        }
    }
}

/// Whether the service refuses a call that comes now for its t0.
fn is_too_old(call: &AnnounceRequest) -> bool {
    const OLDEST_MS: i64 = 30_000;
    call.t0.is_some() && us(&call.t0) <= us(&from_now(-OLDEST_MS))
}
