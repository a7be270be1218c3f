//! The explainer's task: takes the newest plan that has no explanation, one at a time, until all have one,
//! and sleeps until the next tour is out.

use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;
use tracing::Instrument;
use voltour_solver::explain::explain;

use super::work::{Done, Explain, Work};
use crate::clock::Clock;
use crate::domain::{PlanId, Refusal};
use crate::metrics::{ExplanationOutcome, Metrics};
use crate::store::{Attempt, BeginExplanation, EndExplanation, Reads, StoreError, Writer};

/// How long it waits after the database failed it.
const PAUSE: Duration = Duration::from_secs(1);

/// What an operator may set of it.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Time that one explanation may take; 0 where none are made.
    pub budget: Duration,
    /// Seed of its searches.
    pub seed: u64,
}

/// The task and what it needs.
#[derive(Debug)]
pub struct Explainer {
    reads: Reads,
    writer: Writer,
    clock: Arc<dyn Clock>,
    settings: Settings,
    metrics: Metrics,
    cancel: CancellationToken,
    pub(super) explain: Explain,
}

/// Why an explanation could not be begun or stored now.
#[derive(Debug, thiserror::Error)]
enum Stuck {
    #[error("{0}")]
    Store(#[from] StoreError),
    #[error("{0}")]
    Refused(#[from] Refusal),
}

impl Explainer {
    /// Of a store; `cancel` ends it.
    pub fn new(
        reads: Reads,
        writer: Writer,
        clock: Arc<dyn Clock>,
        settings: Settings,
        metrics: Metrics,
        cancel: CancellationToken,
    ) -> Self {
        Self { reads, writer, clock, settings, metrics, cancel, explain }
    }

    /// Runs until it is cancelled, or until the writer has ended. It must end before the writer does for an
    /// interrupted explanation not to count as an attempt.
    pub async fn run(self) {
        if self.settings.budget.is_zero() {
            return;
        }
        let mut tours = self.writer.tour_changes();
        while !self.cancel.is_cancelled() {
            // Before the look into the database: what is stored after it wakes us.
            tours.mark_unchanged();
            match self.round().await {
                Ok(true) => {}
                Ok(false) => tokio::select! {
                    () = self.cancel.cancelled() => return,
                    changed = tours.changed() => if changed.is_err() { return },
                },
                Err(_) if self.cancel.is_cancelled() => return,
                Err(error) => {
                    tracing::error!(%error, "explanations cannot be read or written");
                    tokio::select! {
                        () = self.cancel.cancelled() => return,
                        () = self.clock.pause(PAUSE) => {}
                    }
                }
            }
        }
    }

    /// Explains one plan; false where there was none to explain.
    async fn round(&self) -> Result<bool, Stuck> {
        let Some(plan_id) = self.reads.unexplained().await? else { return Ok(false) };
        if !self.writer.call(BeginExplanation { plan_id }).await? {
            return Ok(false);
        }
        let span = tracing::info_span!("explanation", plan = %plan_id);
        let attempt = self.attempt(plan_id).instrument(span).await?;
        let outcome = match &attempt {
            Attempt::Explained(_) => Some(ExplanationOutcome::Done),
            Attempt::GivenUp => Some(ExplanationOutcome::Failed),
            Attempt::Interrupted => None,
        };
        self.writer.call(EndExplanation { plan_id, attempt }).await?;
        tracing::debug!(plan = %plan_id, ?outcome, "an explanation has ended");
        if let Some(outcome) = outcome {
            self.metrics.planning.explained(outcome);
        }
        Ok(true)
    }

    async fn attempt(&self, plan_id: PlanId) -> Result<Attempt, Stuck> {
        let envelope = self.reads.plan_envelope(plan_id).await?;
        let scenario = self.reads.plan_scenario(plan_id).await?;
        let work = Work {
            // A row that is not there cannot be read either.
            envelope: envelope.unwrap_or_default(),
            scenario: scenario.unwrap_or_default(),
            explain: self.explain,
            seed: self.settings.seed,
            budget: self.settings.budget,
            clock: self.clock.clone(),
            cancel: self.cancel.clone(),
        };
        let mut thread = tokio::task::spawn_blocking(move || work.run());
        let done = tokio::select! {
            biased;
            done = &mut thread => done,
            // The thread sees it too and ends; whatever it still finds is not waited for.
            () = self.cancel.cancelled() => return Ok(Attempt::Interrupted),
        };
        Ok(match done {
            Ok(Ok(Done { complete, .. })) if !complete && self.cancel.is_cancelled() => {
                Attempt::Interrupted
            }
            Ok(Ok(Done { document, .. })) => Attempt::Explained(document),
            Ok(Err(error)) => given_up(plan_id, &error),
            Err(error) if error.is_panic() => given_up(plan_id, &error),
            // The runtime ends.
            Err(_) => Attempt::Interrupted,
        })
    }
}

fn given_up(plan: PlanId, error: &dyn std::fmt::Display) -> Attempt {
    tracing::error!(%plan, %error, "a defect: the plan cannot be explained");
    Attempt::GivenUp
}
