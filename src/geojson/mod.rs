//! The map of a plan: a GeoJSON document (RFC 7946) made from a scenario and its plan alone. Knows neither the
//! service nor the command line.
//!
//! A scenario lies in a plane and is in metres; GeoJSON lies on the earth and is in degrees. Where the caller says
//! where the plane's origin is on the earth, the map is on the earth too; else it stays in metres, which RFC 7946
//! allows among those who have agreed on it (section 4), and which no tool can tell from degrees by itself.

mod map;
mod origin;

pub use map::{OutOfReach, map};
pub use origin::Origin;
