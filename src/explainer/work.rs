//! One explanation, on a thread that may take its time: from the stored documents to the document.

use std::cell::Cell;
use std::sync::Arc;
use std::time::Duration;

use tokio_util::sync::CancellationToken;
use voltour_solver::explain::Explanation;
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::stop::StopRule;

use crate::clock::Clock;
use crate::planner::{self, Unreadable};
use crate::store::pack;

/// How a plan is explained: `voltour_solver::explain::explain`, but in tests.
pub(super) type Explain = fn(&Scenario, &Plan, u64, &dyn StopRule) -> Explanation;

/// A plan to explain.
pub(super) struct Work {
    pub envelope: Vec<u8>,
    pub scenario: Vec<u8>,
    pub explain: Explain,
    pub seed: u64,
    pub budget: Duration,
    pub clock: Arc<dyn Clock>,
    pub cancel: CancellationToken,
}

/// What came of it.
pub(super) struct Done {
    /// Whether every question got its answer.
    pub complete: bool,
    /// The document, compressed.
    pub document: Vec<u8>,
}

/// A defect: it would fail again.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failed {
    #[error("the stored plan cannot be read: {0}")]
    Plan(#[from] Unreadable),
    #[error("the explanation is no document: {0}")]
    Explanation(#[from] serde_json::Error),
    #[error("the explanation cannot be compressed: {0}")]
    Pack(#[from] std::io::Error),
}

impl Work {
    pub fn run(self) -> Result<Done, Failed> {
        let (scenario, plan) = planner::stored(&self.envelope, &self.scenario)?;
        let limit = Limit { work: &self, until: Cell::new(None) };
        let explanation = (self.explain)(&scenario, &plan, self.seed, &limit);
        let json = serde_json::to_vec(&explanation)?;
        // A number that JSON does not have would be written as null, and found out by who asks for the text.
        serde_json::from_slice::<Explanation>(&json)?;
        Ok(Done { complete: explanation.complete, document: pack(&json)? })
    }
}

/// Ends the search for answers in time; the time begins with the first question, for compiling a
/// large scenario is no part of it.
struct Limit<'a> {
    work: &'a Work,
    until: Cell<Option<Duration>>,
}

impl StopRule for Limit<'_> {
    fn should_stop(&self, _: u64) -> bool {
        let ran = self.work.clock.ran();
        let until = self.until.get().unwrap_or_else(|| {
            let until = ran + self.work.budget;
            self.until.set(Some(until));
            until
        });
        self.work.cancel.is_cancelled() || ran >= until
    }
}
