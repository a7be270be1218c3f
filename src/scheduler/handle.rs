//! The cheap handle that the edges hold: one method a call of `service.md`.

use tokio::sync::watch;

use crate::domain::{
    Announcement, Call, ChargerId, Departure, DepartureId, Network, NetworkId, NetworkSpec,
    NewRequest, NewVisit, Refusal, Request, RequestId, SensorId, TimedPoint, Tour, TourId, Visit,
};
use crate::store::Reads;

/// To the running scheduler; cheap to clone.
#[derive(Clone, Debug)]
pub struct Handle {}

/// Content of `NetworkService.Put`.
#[derive(Clone, Debug, serde::Serialize)]
#[allow(missing_docs)]
pub struct PutNetwork {
    pub network_id: NetworkId,
    pub spec: NetworkSpec,
    pub expected_version: Option<u64>,
}

/// Content of `NetworkService.UpdateTrajectory`.
#[derive(Clone, Debug, serde::Serialize)]
#[allow(missing_docs)]
pub struct UpdateTrajectories {
    pub network_id: NetworkId,
    pub trajectories: Vec<(SensorId, Vec<TimedPoint>)>,
}

/// Content of `RequestService.Withdraw`.
#[derive(Clone, Debug, serde::Serialize)]
#[allow(missing_docs)]
pub struct Withdraw {
    pub network_id: NetworkId,
    pub request_id: RequestId,
}

/// Content of `DepartureService.Cancel`.
#[derive(Clone, Debug, serde::Serialize)]
#[allow(missing_docs)]
pub struct CancelDeparture {
    pub departure_id: DepartureId,
    pub reason: String,
}

#[allow(missing_docs)]
impl Handle {
    pub async fn put_network(&self, _call: Call<PutNetwork>) -> Result<Network, Refusal> {
        todo!()
    }
    pub async fn update_trajectories(
        &self,
        _call: Call<UpdateTrajectories>,
    ) -> Result<u32, Refusal> {
        todo!()
    }
    pub async fn submit(&self, _call: Call<NewRequest>) -> Result<Request, Refusal> {
        todo!()
    }
    pub async fn withdraw(&self, _call: Call<Withdraw>) -> Result<Request, Refusal> {
        todo!()
    }
    pub async fn announce(&self, _call: Call<Announcement>) -> Result<Departure, Refusal> {
        todo!()
    }
    pub async fn cancel(&self, _call: Call<CancelDeparture>) -> Result<Departure, Refusal> {
        todo!()
    }
    pub async fn report_visit(&self, _call: Call<NewVisit>) -> Result<Visit, Refusal> {
        todo!()
    }
    pub async fn complete(&self, _call: Call<TourId>) -> Result<Tour, Refusal> {
        todo!()
    }
    /// Waits until the charger's next tour is stored; the caller bounds the wait by dropping the future.
    pub async fn next_tour(
        &self,
        _network_id: &NetworkId,
        _charger_id: &ChargerId,
        _departure_id: Option<DepartureId>,
    ) -> Result<Tour, Refusal> {
        todo!()
    }
    /// For `Get` and `List`, and for what a watch reads after it was woken.
    pub fn reads(&self) -> &Reads {
        todo!()
    }
    /// The number of the last committed change; wakes watches.
    pub fn changes(&self) -> watch::Receiver<u64> {
        todo!()
    }
}
