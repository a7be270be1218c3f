//! What the service speaks of: networks, requests, departures, tours. Valid by construction where an
//! id or a time is concerned; knows neither the wire nor the database.

mod call;
mod departure;
pub mod documents;
mod ids;
mod network;
mod refusal;
mod request;
pub mod rules;
mod token;
mod tour;

pub use call::{Call, CancelDeparture, Fingerprint, PutNetwork, UpdateTrajectories, Withdraw};
pub use departure::{Announcement, Departure, DepartureState};
pub use ids::{
    ChargerId, ClientId, DepartureId, IdError, NetworkId, PlanId, RequestId, SensorId, TokenId,
    TokenName, TourId, VisitId,
};
pub use network::{ChargerType, Coverage, Network, NetworkSpec, Place, Sensor, TimedPoint};
pub use refusal::{FieldViolation, Refusal};
pub use request::{NewRequest, Request, RequestState};
pub use token::{Grant, NetworkScope, Role, Token, TokenHash};
pub use tour::{
    Contender, NewVisit, Outcome, PhaseIterations, PolicyUsed, Provenance, Stop, Tour, TourState,
    Versions, Visit,
};
