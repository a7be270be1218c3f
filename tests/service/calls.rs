//! Calls of a test that must succeed, in one word each.

use std::time::Duration;

use serde_json::Value;
use tonic::Request;
use voltour::proto::{
    AnnounceRequest, ChargingRequest, Departure, DepartureState, GetDepartureRequest,
    GetNextRequest, GetRequestRequest, Network, NetworkSpec, RequestState, SubmitRequest, Tour,
    Visit, VisitOutcome,
};

use crate::app::{PATIENCE, TestApp};
use crate::field::{self, FIELD};
use crate::time::until;

pub const OPEN: i32 = RequestState::Open as i32;
pub const BATCHED: i32 = RequestState::Batched as i32;
pub const PLANNED: i32 = RequestState::Planned as i32;
pub const SERVED: i32 = RequestState::Served as i32;
pub const EXPIRED: i32 = RequestState::Expired as i32;
pub const WITHDRAWN: i32 = RequestState::Withdrawn as i32;
pub const SUPERSEDED: i32 = RequestState::Superseded as i32;

impl TestApp {
    /// Puts the network of the test.
    pub async fn put(&self, spec: NetworkSpec) -> Network {
        self.networks().put(field::put(spec)).await.expect("Put").into_inner()
    }

    /// Submits a request that has nothing but a sensor.
    pub async fn ask(&self, sensor: &str) -> ChargingRequest {
        self.submit(field::request(sensor)).await
    }

    pub async fn submit(&self, request: SubmitRequest) -> ChargingRequest {
        self.requests().submit(request).await.expect("Submit").into_inner()
    }

    pub async fn request(&self, id: &str) -> ChargingRequest {
        let get = GetRequestRequest { request_id: id.to_owned() };
        self.requests().get(get).await.expect("Get").into_inner()
    }

    pub async fn state(&self, request_id: &str) -> i32 {
        self.request(request_id).await.state
    }

    pub async fn withdraw(&self, request_id: &str) -> ChargingRequest {
        let call = field::withdrawal(request_id);
        self.requests().withdraw(call).await.expect("Withdraw").into_inner()
    }

    /// Announces that a charger leaves as soon as can be.
    pub async fn depart(&self, charger: &str) -> Departure {
        self.announce(field::departure(charger)).await
    }

    pub async fn announce(&self, announcement: AnnounceRequest) -> Departure {
        self.departures().announce(announcement).await.expect("Announce").into_inner()
    }

    pub async fn departure(&self, id: &str) -> Departure {
        let get = GetDepartureRequest { departure_id: id.to_owned() };
        self.departures().get(get).await.expect("Get").into_inner()
    }

    /// Waits until a departure is in a state.
    pub async fn departure_in(&self, id: &str, state: DepartureState) -> Departure {
        until(&format!("departure {state:?}"), || async {
            Some(self.departure(id).await).filter(|d| d.state == state as i32)
        })
        .await
    }

    /// The tour of a departure, once there is one.
    pub async fn tour(&self, departure: &Departure) -> Tour {
        let charger = &departure.announced.as_ref().expect("what was announced").charger_id;
        let mut next = Request::new(GetNextRequest {
            network_id: FIELD.into(),
            charger_id: charger.clone(),
            departure_id: departure.id.clone(),
        });
        next.set_timeout(PATIENCE);
        self.tours().get_next(next).await.expect("GetNext").into_inner()
    }

    /// Announces a departure as soon as can be, and waits for its tour.
    pub async fn drive(&self, charger: &str) -> Tour {
        let departure = self.depart(charger).await;
        self.tour(&departure).await
    }

    /// Reports that a sensor was charged.
    pub async fn charged(&self, tour: &Tour, sensor: &str) -> Visit {
        let visit = field::visit(&tour.id, sensor, VisitOutcome::Charged);
        self.tours().report_visit(visit).await.expect("ReportVisit").into_inner()
    }

    pub async fn complete(&self, tour: &Tour) -> Tour {
        let call = field::completion(&tour.id);
        self.tours().complete(call).await.expect("Complete").into_inner()
    }

    pub async fn cancel(&self, departure_id: &str) -> Departure {
        let call = field::cancellation(departure_id);
        self.departures().cancel(call).await.expect("Cancel").into_inner()
    }

    /// The answer of a REST route.
    pub async fn get(&self, path: &str) -> reqwest::Response {
        let client = reqwest::Client::builder().timeout(PATIENCE).build().expect("a client");
        client.get(format!("{}{path}", self.rest)).send().await.expect("an answer")
    }

    /// The document of a REST route that must be there.
    pub async fn json(&self, path: &str) -> Value {
        let answer = self.get(path).await;
        let status = answer.status();
        let text = answer.text().await.expect("a body");
        assert_eq!(status, 200, "{path}: {text}");
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}: {text}"))
    }

    /// The scenario that a tour was planned on.
    pub async fn scenario(&self, tour: &Tour) -> Value {
        self.json(&format!("/v1/plans/{}/scenario", tour.plan_id)).await
    }
}

/// The sensors of a tour's stops, in driving order.
pub fn sensors(tour: &Tour) -> Vec<&str> {
    tour.stops.iter().map(|stop| stop.sensor_id.as_str()).collect()
}

/// The sensors of a scenario's list.
pub fn listed<'a>(scenario: &'a Value, list: &str, key: &str) -> Vec<&'a str> {
    let items = scenario[list].as_array().expect("a list");
    items.iter().map(|item| item[key].as_str().expect("a sensor")).collect()
}

/// A time limit on whatever should not hang.
pub async fn soon<T>(what: &str, wait: impl Future<Output = T>) -> T {
    let result = tokio::time::timeout(PATIENCE, wait).await;
    result.unwrap_or_else(|_| panic!("waited in vain: {what}"))
}

/// A moment that is long for the server and short for the test.
pub const MOMENT: Duration = Duration::from_millis(700);
