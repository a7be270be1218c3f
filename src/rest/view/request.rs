//! Charging requests.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;
use uuid::Uuid;

use super::Place;
use crate::domain;

/// Where a request is in its life
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(in crate::rest) enum RequestState {
    Open,
    Batched,
    Planned,
    Served,
    Expired,
    Withdrawn,
    Superseded,
}

impl From<domain::RequestState> for RequestState {
    fn from(state: domain::RequestState) -> Self {
        use domain::RequestState as State;
        match state {
            State::Open => Self::Open,
            State::Batched => Self::Batched,
            State::Planned => Self::Planned,
            State::Served => Self::Served,
            State::Expired => Self::Expired,
            State::Withdrawn => Self::Withdrawn,
            State::Superseded => Self::Superseded,
        }
    }
}

/// A charging request
#[derive(Debug, Serialize, ToSchema)]
pub(in crate::rest) struct Request {
    id: Uuid,
    state: RequestState,
    network_id: String,
    /// Free text
    sensor_id: String,
    client_id: String,
    /// Where the sensor is said to be; the registered place if both are null
    #[serde(flatten)]
    place: Place,
    /// Charging must begin at or before it
    deadline: Option<Timestamp>,
    /// Charging may not begin before it
    ready: Option<Timestamp>,
    /// Energy left at `measured_at`
    residual_j: Option<f64>,
    measured_at: Option<Timestamp>,
    drain_w: Option<f64>,
    reward: Option<f64>,
    /// The tour must serve it
    required: bool,
    received_at: Timestamp,
    updated_at: Timestamp,
    /// In whose batch it is or was last
    departure_id: Option<Uuid>,
    /// Of which it is or was a stop last
    tour_id: Option<Uuid>,
    /// Taken back while its batch was frozen
    withdrawal_pending: bool,
}

impl From<domain::Request> for Request {
    fn from(request: domain::Request) -> Self {
        let asked = request.asked;
        Self {
            id: request.id.0,
            state: request.state.into(),
            network_id: asked.network_id.into(),
            sensor_id: asked.sensor_id.into(),
            client_id: request.client_id.into(),
            place: asked.place.map(Into::into).unwrap_or_default(),
            deadline: asked.deadline,
            ready: asked.ready,
            residual_j: asked.residual_j,
            measured_at: asked.measured_at,
            drain_w: asked.drain_w,
            reward: asked.reward,
            required: asked.required,
            received_at: request.received_at,
            updated_at: request.updated_at,
            departure_id: request.departure_id.map(|id| id.0),
            tour_id: request.tour_id.map(|id| id.0),
            withdrawal_pending: request.withdrawal_pending,
        }
    }
}
