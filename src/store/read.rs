//! Reads: each from the pool of read-only connections, never behind the writer.

use jiff::Timestamp;
use serde::Serialize;

use super::StoreError;
use super::page::{DepartureFilter, Listed, Page, PlanFilter, RequestFilter};
use crate::domain::{
    ChargerId, Departure, DepartureId, Network, NetworkId, PlanId, Request, RequestId, Tour, TourId,
};

/// The read half of the store; cheap to clone.
#[derive(Clone, Debug)]
pub struct Reads {}

/// A plan in a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct PlanSummary {
    pub id: PlanId,
    pub departure_id: DepartureId,
    pub revision: u32,
    pub network_id: NetworkId,
    pub charger_id: ChargerId,
    pub status: String,
    pub solver: String,
    pub objective: f64,
    pub bound: Option<f64>,
    pub distance_m: f64,
    pub stops: u32,
    pub unserved: u32,
    pub start: Timestamp,
    pub finish: Timestamp,
    pub created_at: Timestamp,
}

impl Reads {
    /// The present version of a network with its spec; none where there is no such network.
    pub async fn network(&self, _id: &NetworkId) -> Result<Option<Network>, StoreError> {
        todo!()
    }
    /// Networks by id, without specs.
    pub async fn networks(&self, _page: &Page) -> Result<Listed<Network>, StoreError> {
        todo!()
    }
    /// A request.
    pub async fn request(&self, _id: RequestId) -> Result<Option<Request>, StoreError> {
        todo!()
    }
    /// Requests, newest first.
    pub async fn requests(
        &self,
        _f: &RequestFilter,
        _page: &Page,
    ) -> Result<Listed<Request>, StoreError> {
        todo!()
    }
    /// Requests of a network that changed after `change`, in the order of their change.
    pub async fn requests_since(
        &self,
        _n: &NetworkId,
        _change: u64,
        _limit: u32,
    ) -> Result<Vec<Request>, StoreError> {
        todo!()
    }
    /// Requests of a network that are open, batched or planned, and the change they were read at.
    pub async fn live_requests(&self, _n: &NetworkId) -> Result<(Vec<Request>, u64), StoreError> {
        todo!()
    }
    /// A departure.
    pub async fn departure(&self, _id: DepartureId) -> Result<Option<Departure>, StoreError> {
        todo!()
    }
    /// Departures, newest first.
    pub async fn departures(
        &self,
        _f: &DepartureFilter,
        _page: &Page,
    ) -> Result<Listed<Departure>, StoreError> {
        todo!()
    }
    /// Departures of a network that changed after `change`, in the order of their change.
    pub async fn departures_since(
        &self,
        _n: &NetworkId,
        _change: u64,
        _limit: u32,
    ) -> Result<Vec<Departure>, StoreError> {
        todo!()
    }
    /// Departures that are announced, closed or planned, and the change they were read at.
    pub async fn live_departures(
        &self,
        _n: &NetworkId,
    ) -> Result<(Vec<Departure>, u64), StoreError> {
        todo!()
    }
    /// A tour with its stops.
    pub async fn tour(&self, _id: TourId) -> Result<Option<Tour>, StoreError> {
        todo!()
    }
    /// The tour of a charger that is out.
    pub async fn tour_out(
        &self,
        _n: &NetworkId,
        _c: &ChargerId,
    ) -> Result<Option<Tour>, StoreError> {
        todo!()
    }
    /// Tours of a network that changed after `change`, in the order of their change.
    pub async fn tours_since(
        &self,
        _n: &NetworkId,
        _change: u64,
        _limit: u32,
    ) -> Result<Vec<Tour>, StoreError> {
        todo!()
    }
    /// Tours that are out, and the change they were read at.
    pub async fn live_tours(&self, _n: &NetworkId) -> Result<(Vec<Tour>, u64), StoreError> {
        todo!()
    }
    /// Plans, newest first.
    pub async fn plans(
        &self,
        _f: &PlanFilter,
        _page: &Page,
    ) -> Result<Listed<PlanSummary>, StoreError> {
        todo!()
    }
    /// The envelope `{plan, provenance}` of a plan, as JSON text.
    pub async fn plan_envelope(&self, _id: PlanId) -> Result<Option<Vec<u8>>, StoreError> {
        todo!()
    }
    /// The scenario of a plan, as JSON text.
    pub async fn plan_scenario(&self, _id: PlanId) -> Result<Option<Vec<u8>>, StoreError> {
        todo!()
    }
    /// Whether the database answers: for readiness.
    pub async fn ping(&self) -> Result<(), StoreError> {
        todo!()
    }
}
