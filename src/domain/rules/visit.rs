//! The rules of a visit report and of a cancellation; whether there is such a sensor is judged where
//! the tour is known.

use super::Violations;
use crate::domain::{NewVisit, Refusal};

/// Bytes of a note at most.
const NOTE: usize = 1024;
/// Bytes of a reason at most.
const REASON: usize = 256;

/// Judges a report.
///
/// # Errors
/// Every broken rule that was found, under the names of the report's fields.
pub fn visit(visit: &NewVisit) -> Result<(), Refusal> {
    let mut violations = Violations::default();
    violations.not_negative("charge_j", visit.charge_j);
    if let (Some(arrived), Some(departed)) = (visit.arrived_at, visit.departed_at)
        && departed < arrived
    {
        let rule = format!("{departed}: must be at or after the arrival ({arrived})");
        violations.add("departed_at", rule);
    }
    let note = visit.note.as_ref().map_or(0, String::len);
    if note > NOTE {
        violations.add("note", format!("{note} bytes: must be at most {NOTE}"));
    }
    violations.verdict()
}

/// Judges the reason of a cancellation.
///
/// # Errors
/// It is too long.
pub fn cancellation(reason: &str) -> Result<(), Refusal> {
    let mut violations = Violations::default();
    if reason.len() > REASON {
        violations.add("reason", format!("{} bytes: must be at most {REASON}", reason.len()));
    }
    violations.verdict()
}
