//! The rules of what comes in, beyond what its types keep already. Whatever the scenario format has a
//! rule for is judged by the scenario's own validation, so that there is one implementation of it.

mod announcement;
mod known;
mod network;
mod path;
mod request;
#[cfg(test)]
mod tests;
mod visit;

pub use announcement::announcement;
pub use known::KnownNetwork;
pub use network::network;
pub use request::{request, trajectories};
pub use visit::{cancellation, visit};

use super::{FieldViolation, Refusal};

/// How far a client's clock may be ahead or behind.
pub const SLACK: std::time::Duration = std::time::Duration::from_secs(30);

/// Collects what is wrong; past some, more of it helps nobody.
#[derive(Debug, Default)]
struct Violations(Vec<FieldViolation>);

impl Violations {
    const MOST: usize = 100;

    fn add(&mut self, field: impl Into<String>, description: impl Into<String>) {
        if self.0.len() < Self::MOST {
            self.0.push(FieldViolation { field: field.into(), description: description.into() });
        }
    }

    fn not_negative(&mut self, field: &str, value: Option<f64>) {
        if let Some(value) = value.filter(|value| !(*value >= 0.0 && value.is_finite())) {
            self.add(field, format!("{value}: must be >= 0"));
        }
    }

    fn finite(&mut self, field: &str, point: Option<[f64; 2]>) {
        if let Some([x, y]) = point.filter(|point| !point.iter().all(|value| value.is_finite())) {
            self.add(field, format!("[{x}, {y}]: must be finite"));
        }
    }

    fn verdict(self) -> Result<(), Refusal> {
        if self.0.is_empty() { Ok(()) } else { Err(Refusal::Invalid(self.0)) }
    }
}
