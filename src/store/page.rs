//! Pages and filters of lists. Lists go newest first (networks: by id), keyed by the last id of the
//! page before, so that what is added meanwhile moves nothing.

use jiff::Timestamp;

use crate::domain::{ChargerId, DepartureState, NetworkId, NetworkScope, RequestState, SensorId};

/// Which page of a list.
#[derive(Clone, Debug)]
pub struct Page {
    /// From 1 to [`Page::LARGEST`].
    pub limit: u32,
    /// The id of the last item of the page before.
    pub after: Option<String>,
}

impl Page {
    /// The largest page.
    pub const LARGEST: u32 = 500;
    /// The page where the caller does not say.
    pub const DEFAULT: u32 = 50;
}

/// A page of a list.
#[derive(Clone, Debug)]
pub struct Listed<T> {
    /// At most as many as asked.
    pub items: Vec<T>,
    /// What [`Page::after`] is for the next page; none on the last.
    pub next: Option<String>,
}

/// Which requests to list; everything that is none or empty lets all pass.
#[derive(Clone, Debug, Default)]
pub struct RequestFilter {
    /// Of those that the caller knows of.
    pub within: NetworkScope,
    /// Of this network.
    pub network_id: Option<NetworkId>,
    /// In one of these states.
    pub states: Vec<RequestState>,
    /// Of this sensor.
    pub sensor_id: Option<SensorId>,
}

/// Which departures to list.
#[derive(Clone, Debug, Default)]
pub struct DepartureFilter {
    /// Of those that the caller knows of.
    pub within: NetworkScope,
    /// Of this network.
    pub network_id: Option<NetworkId>,
    /// Of this charger.
    pub charger_id: Option<ChargerId>,
    /// In one of these states.
    pub states: Vec<DepartureState>,
}

/// Which plans to list.
#[derive(Clone, Debug, Default)]
pub struct PlanFilter {
    /// Of those that the caller knows of.
    pub within: NetworkScope,
    /// Of this network.
    pub network_id: Option<NetworkId>,
    /// Of this charger.
    pub charger_id: Option<ChargerId>,
    /// Of this status, as the plan document spells it.
    pub status: Option<String>,
    /// Of this solver.
    pub solver: Option<String>,
    /// Made at or after it.
    pub from: Option<Timestamp>,
    /// Made before it.
    pub until: Option<Timestamp>,
}
