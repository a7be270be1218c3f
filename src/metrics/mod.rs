//! What the service counts, for a monitor to read. Names and labels are a contract with dashboards; every
//! label has a fixed set of values, so that no client can make the table grow.

mod labels;
mod registry;

pub use labels::ExplanationOutcome;
pub use registry::Metrics;
