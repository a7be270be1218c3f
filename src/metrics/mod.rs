//! What the service counts, for a monitor to read. Names and labels are a contract with dashboards; every
//! label has a fixed set of values, so that no client can make the table grow.

mod calls;
mod counted;
mod labels;
mod level;
mod planning;
mod registry;
mod writing;

pub use calls::{Calls, GrpcCall};
pub use labels::ExplanationOutcome;
pub use level::{Entered, Level};
pub use planning::Planning;
pub use registry::Metrics;
pub use writing::WriterMetrics;

use labels::{SUBMITTED, TIMES_S};
