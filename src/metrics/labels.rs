//! The labels, each with its values.

use prometheus_client::encoding::{EncodeLabelSet, EncodeLabelValue, LabelValueEncoder};

/// Bounds of the histograms of times.
pub(super) const TIMES_S: [f64; 15] =
    [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0];

/// What may become of a charging request that is submitted.
pub(super) const SUBMITTED: [&str; 8] = [
    "accepted",
    "duplicate",
    "invalid",
    "not_found",
    "already_exists",
    "exhausted",
    "unavailable",
    "refused",
];

/// Of plans.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct PlanLabels {
    /// Whose tour it is.
    pub solver: String,
    /// As the plan document spells it.
    pub status: &'static str,
}

/// Of explanations.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct ExplanationLabels {
    pub outcome: ExplanationOutcome,
}

/// Of plans that were made without the policy.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct FallbackLabels {
    /// As the provenance spells it.
    pub reason: &'static str,
}

/// Of plans for which the policy built a tour.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct WinLabels {
    /// Whose tour was the best.
    pub winner: &'static str,
}

/// Of models that were loaded again.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct ReloadLabels {
    /// What became of it.
    pub outcome: &'static str,
}

/// Of times of plans.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct SolverLabels {
    /// Whose tour it is.
    pub solver: String,
}

/// Of submissions.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct SubmissionLabels {
    /// One of [`SUBMITTED`].
    pub outcome: &'static str,
}

/// Of departures.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct StateLabels {
    pub state: &'static str,
}

/// Of files of the database.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct FileLabels {
    pub file: &'static str,
}

/// Of connections.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct EdgeLabels {
    pub edge: &'static str,
}

/// Of gRPC calls.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct GrpcLabels {
    pub method: &'static str,
    pub code: &'static str,
}

/// Of times of gRPC calls.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct MethodLabels {
    pub method: &'static str,
}

/// Of REST calls.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct RestLabels {
    pub method: &'static str,
    pub route: &'static str,
    pub code: u16,
}

/// Of times of REST calls.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
pub(super) struct RouteLabels {
    pub route: &'static str,
}

/// What became of an explanation; one that the end of the service cut short is counted when it is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ExplanationOutcome {
    /// It is stored.
    Done,
    /// It was given up.
    Failed,
}

impl EncodeLabelValue for ExplanationOutcome {
    fn encode(&self, encoder: &mut LabelValueEncoder) -> Result<(), std::fmt::Error> {
        let word = match self {
            Self::Done => "done",
            Self::Failed => "failed",
        };
        EncodeLabelValue::encode(&word, encoder)
    }
}
