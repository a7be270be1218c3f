//! The labels, each with its values.

use prometheus_client::encoding::{EncodeLabelSet, EncodeLabelValue, LabelValueEncoder};

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
