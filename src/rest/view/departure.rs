//! Departures.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::domain;

/// Where a departure is in its life
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(in crate::rest) enum DepartureState {
    Announced,
    Closed,
    Planned,
    Completed,
    Overdue,
    Cancelled,
    Missed,
}

impl From<domain::DepartureState> for DepartureState {
    fn from(state: domain::DepartureState) -> Self {
        use domain::DepartureState as State;
        match state {
            State::Announced => Self::Announced,
            State::Closed => Self::Closed,
            State::Planned => Self::Planned,
            State::Completed => Self::Completed,
            State::Overdue => Self::Overdue,
            State::Cancelled => Self::Cancelled,
            State::Missed => Self::Missed,
        }
    }
}

/// A departure of a charger
#[derive(Debug, Serialize, ToSchema)]
pub(in crate::rest) struct Departure {
    id: Uuid,
    state: DepartureState,
    network_id: String,
    charger_id: String,
    client_id: String,
    charger_type: Option<String>,
    /// In place of the charger type's
    start_m: Option<[f64; 2]>,
    end_m: Option<[f64; 2]>,
    capacity_j: Option<f64>,
    timespan_s: Option<f64>,
    announced_at: Timestamp,
    updated_at: Timestamp,
    t0: Timestamp,
    /// When its batch closes, or was closed
    closes_at: Timestamp,
    /// Second 0 of the scenario, once closed
    start: Option<Timestamp>,
    network_version: Option<u64>,
    batch_size: u32,
    /// The newest plan
    plan_id: Option<Uuid>,
    tour_ids: Vec<Uuid>,
    /// Why it was cancelled or missed
    reason: Option<String>,
}

impl From<domain::Departure> for Departure {
    fn from(departure: domain::Departure) -> Self {
        let announced = departure.announced;
        Self {
            id: departure.id.0,
            state: departure.state.into(),
            network_id: announced.network_id.into(),
            charger_id: announced.charger_id.into(),
            client_id: departure.client_id.into(),
            charger_type: announced.charger_type,
            start_m: announced.start_m,
            end_m: announced.end_m,
            capacity_j: announced.capacity_j,
            timespan_s: announced.timespan_s,
            announced_at: departure.announced_at,
            updated_at: departure.updated_at,
            t0: departure.t0,
            closes_at: departure.closes_at,
            start: departure.start,
            network_version: departure.network_version,
            batch_size: departure.batch_size,
            plan_id: departure.plan_id.map(|id| id.0),
            tour_ids: departure.tour_ids.into_iter().map(|id| id.0).collect(),
            reason: departure.reason,
        }
    }
}
