//! A charging request and its life: open, batched, planned, served; or one of the other ends.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::{ClientId, DepartureId, NetworkId, Place, RequestId, SensorId, TourId};

/// What a base station asks for a sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NewRequest {
    /// The network.
    pub network_id: NetworkId,
    /// A sensor of it.
    pub sensor_id: SensorId,
    /// Where the sensor is; the registered place if none.
    pub place: Option<Place>,
    /// Charging must begin at or before it.
    pub deadline: Option<Timestamp>,
    /// Charging may not begin before it.
    pub ready: Option<Timestamp>,
    /// Energy left at `measured_at`.
    pub residual_j: Option<f64>,
    /// The receipt if none.
    pub measured_at: Option<Timestamp>,
    /// The sensor's if none.
    pub drain_w: Option<f64>,
    /// The energy needed if none.
    pub reward: Option<f64>,
    /// The tour must serve it.
    pub required: bool,
}

/// Where a request is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RequestState {
    /// Waits for a departure.
    Open,
    /// In a batch that is being planned.
    Batched,
    /// A stop of a tour that is out.
    Planned,
    /// Charged.
    Served,
    /// Its deadline passed before a departure could serve it.
    Expired,
    /// Taken back.
    Withdrawn,
    /// A newer request of its sensor took its place.
    Superseded,
}

/// A request as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Its id.
    pub id: RequestId,
    /// Where it is in its life.
    pub state: RequestState,
    /// The client's id for the call that made it.
    pub client_id: ClientId,
    /// What was asked.
    #[serde(flatten)]
    pub asked: NewRequest,
    /// When it was received.
    pub received_at: Timestamp,
    /// When it last changed.
    pub updated_at: Timestamp,
    /// In whose batch it is or was last.
    pub departure_id: Option<DepartureId>,
    /// Of which it is or was a stop last.
    pub tour_id: Option<TourId>,
    /// Taken back while its batch was frozen.
    pub withdrawal_pending: bool,
    /// Rises with every change of the database.
    #[serde(skip)]
    pub change: u64,
}
