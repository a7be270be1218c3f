//! The way back: from the documents that are stored with a plan to the scenario and the plan.

use serde::Deserialize;
use serde_json::value::RawValue;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Scenario, ScenarioError};

/// A stored document is none: a defect.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// It is no envelope.
    #[error("envelope: {0}")]
    Envelope(#[from] serde_json::Error),
    /// Its plan, or the scenario, breaks a rule of its format.
    #[error("document: {0}")]
    Document(#[from] ScenarioError),
}

#[derive(Deserialize)]
struct Envelope<'a> {
    #[serde(borrow)]
    plan: &'a RawValue,
}

/// The scenario and the plan of a stored envelope and scenario document.
///
/// # Errors
/// One of them is not what is stored there.
pub fn stored(envelope: &[u8], scenario: &[u8]) -> Result<(Scenario, Plan), Unreadable> {
    let envelope: Envelope<'_> = serde_json::from_slice(envelope)?;
    let plan = Plan::from_json(envelope.plan.get().as_bytes())?;
    Ok((Scenario::from_json(scenario)?, plan))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_that_is_none_is_an_error() {
        assert!(matches!(stored(b"{}", b"{}"), Err(Unreadable::Envelope(_))));
        assert!(matches!(stored(br#"{"plan": {}}"#, b"{}"), Err(Unreadable::Document(_))));
        assert!(stored(b"\xff", b"").is_err());
    }
}
