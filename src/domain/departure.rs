//! A departure: a charger leaves, its batch closes, its tour is planned.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::{ChargerId, ClientId, DepartureId, NetworkId, PlanId, TourId};

/// What a charger announces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Announcement {
    /// The network.
    pub network_id: NetworkId,
    /// The charger.
    pub charger_id: ChargerId,
    /// A charger type of the network; its only one if none.
    pub charger_type: Option<String>,
    /// As soon as can be if none.
    pub t0: Option<Timestamp>,
    /// In place of the charger type's.
    pub start_m: Option<[f64; 2]>,
    /// In place of the charger type's.
    pub end_m: Option<[f64; 2]>,
    /// In place of the charger type's.
    pub capacity_j: Option<f64>,
    /// In place of the charger type's.
    pub timespan_s: Option<f64>,
}

/// Where a departure is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepartureState {
    /// Its batch is not closed yet.
    Announced,
    /// Its batch is closed, its plan is being made.
    Closed,
    /// Its tour is out.
    Planned,
    /// Its tour is over.
    Completed,
    /// Nothing was heard for long after the planned finish.
    Overdue,
    /// Called off.
    Cancelled,
    /// Could not be planned in time.
    Missed,
}

/// A departure as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Its id.
    pub id: DepartureId,
    /// Where it is in its life.
    pub state: DepartureState,
    /// The client's id for the call that made it.
    pub client_id: ClientId,
    /// What was announced, the charger type filled in.
    pub announced: Announcement,
    /// When it was announced.
    pub announced_at: Timestamp,
    /// When it last changed.
    pub updated_at: Timestamp,
    /// Announced, or chosen where none was.
    pub t0: Timestamp,
    /// When its batch closes, or was closed.
    pub closes_at: Timestamp,
    /// Second 0 of the scenario, once closed.
    pub start: Option<Timestamp>,
    /// Version of the network that it is planned on, once closed.
    pub network_version: Option<u64>,
    /// Requests in its batch.
    pub batch_size: u32,
    /// Its plan, the newest revision.
    pub plan_id: Option<PlanId>,
    /// The tours of that plan.
    pub tour_ids: Vec<TourId>,
    /// Why it was cancelled or missed.
    pub reason: Option<String>,
    /// Rises with every change of the database.
    #[serde(skip)]
    pub change: u64,
}
