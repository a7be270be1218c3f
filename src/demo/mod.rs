//! The demonstration: a service of its own, and a base station and a charger that are played against
//! it over gRPC in fast motion. They know of each other only through the service and the world, which
//! stands for what is out in the field.

mod base_station;
mod charger;
mod network;
mod stage;
mod tell;
mod world;

pub use stage::run;
