//! The scenario: one departure of one charger, parsed and validated once.
//!
//! [`Document`] is the JSON text's shape, field for field; [`Scenario`] is what remains after every
//! rule of the format held and every default was filled in. Nothing past this module validates again.

mod document;
mod error;
mod json;
mod model;
mod polygon;
mod read;
mod validate;

pub use document::{
    ChargerDocument, CoverageDocument, Document, FORMAT, RequestDocument, SensorDocument,
    TravelDocument,
};
pub use error::ScenarioError;
pub use model::{
    Charger, Coverage, DistanceMatrix, Objective, Place, Point, Request, Scenario, Sensor,
    Trajectory, Waypoint,
};
pub use polygon::Polygon;

pub(crate) use json::parse as parse_json;
pub(crate) use read::Reader;
