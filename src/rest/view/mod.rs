//! What REST shows: field for field what the service knows, in JSON with units in the names. Absent
//! values are null, so that every field is always there.

mod departure;
mod network;
mod page;
mod plan;
mod request;

pub(super) use departure::{Departure, DepartureState};
pub(super) use network::{Network, Place};
pub(super) use page::{DeparturePage, NetworkPage, PlanPage, RequestPage};
pub(super) use plan::{PlanEnvelope, PlanStatus, PlanSummary};
pub(super) use request::{Request, RequestState};
