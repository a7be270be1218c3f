//! Conversions between the wire's messages and the domain's types, both ways. Reading collects every
//! field that breaks a rule and goes on, so that a caller gets all of them in one answer.

mod departure;
mod fields;
mod network;
mod place;
mod request;
mod tour;

pub use departure::{
    announcement, announcement_to_wire, departure, departure_state, departure_to_wire,
};
pub use fields::{Fields, Path, Rule};
pub use network::{network, network_to_wire, put_network, spec_to_wire, trajectories};
pub use place::time_to_wire;
pub use request::{
    new_request, new_request_to_wire, request, request_state, request_state_to_wire,
    request_to_wire,
};
pub use tour::{new_visit, new_visit_to_wire, outcome_to_wire, tour, tour_to_wire, visit_to_wire};

#[cfg(test)]
mod tests;
