//! One departure, from the close of its batch to its tour: closed, planned, stored; and again with a
//! later second 0 where that has passed before the plan was there.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;
use voltour_solver::solvers::solve;

use super::Settings;
use crate::clock::{Clock, minus};
use crate::domain::{Call, CancelDeparture, ClientId, DepartureId, DepartureState, Refusal};
use crate::metrics::Metrics;
use crate::planner::{self, Contest, PlanError, Planned, PolicyPart};
use crate::policy::Shelf;
use crate::store::{Batch, Cancel, CloseBatch, Closing, Reads, StorePlan, Storing, Writer};

/// What is left of the time before second 0 for storing the plan, where the lead has so much to spare.
const TO_STORE: Duration = Duration::from_millis(500);

/// What a departure needs on its way.
#[derive(Clone, Debug)]
pub(super) struct Departing {
    pub writer: Writer,
    pub reads: Reads,
    pub clock: Arc<dyn Clock>,
    pub settings: Settings,
    /// The policies in use when a plan begins are its policies.
    pub policies: Shelf,
    pub metrics: Metrics,
    /// As many batches are planned at once.
    pub planners: Arc<Semaphore>,
    pub cancel: CancellationToken,
}

/// Why a departure could not go on now.
#[derive(Debug, thiserror::Error)]
pub(super) enum Stuck {
    #[error("{0}")]
    Refused(#[from] Refusal),
    #[error("{0}")]
    Plan(#[from] PlanError),
    #[error("the planner's thread failed: {0}")]
    Thread(#[from] tokio::task::JoinError),
}

impl Departing {
    /// Takes a departure as far as it goes now.
    pub async fn depart(&self, id: DepartureId) -> Result<(), Stuck> {
        let mut lead = self.settings.lead;
        loop {
            // A thread first: a closed batch has no time to wait for one.
            let Some(_thread) = self.thread().await else { return Ok(()) };
            let Some(batch) = self.close(id, lead).await? else { return Ok(()) };
            let (start, closed) = (batch.start, self.clock.ran());
            let planned = match self.plan(*batch, lead).await {
                Err(Stuck::Plan(error)) => return self.give_up(id, &error).await,
                planned => planned?,
            };
            let Some(Planned { new: plan, policy }) = planned else { return Ok(()) };
            let took = || self.clock.ran().saturating_sub(closed);
            let took_s = took().as_secs_f64();
            let (status, gap, solver) = (plan.status, plan.gap(), plan.solver.clone());
            match self.writer.call(StorePlan { departure_id: id, start, plan }).await? {
                Storing::Stored(tour) => {
                    self.metrics.planning.planned(&solver, status, gap, took_s);
                    let status = status.name();
                    tracing::info!(departure = %id, %tour, %start, status, solver, gap, "planned");
                    self.tell(id, &policy);
                    return Ok(());
                }
                Storing::Gone => return Ok(()),
                Storing::Late => {
                    tracing::warn!(departure = %id, %start, "the plan came after its second 0");
                    // The batch is larger than the lead was meant for.
                    lead = lead.max(took()).saturating_mul(2).min(self.settings.max_late);
                }
            }
        }
    }

    /// A planner's thread, unless the service ends.
    async fn thread(&self) -> Option<tokio::sync::OwnedSemaphorePermit> {
        let _waits = self.metrics.planning.waiting.enter();
        tokio::select! {
            biased;
            () = self.cancel.cancelled() => None,
            thread = self.planners.clone().acquire_owned() => thread.ok(),
        }
    }

    async fn close(&self, id: DepartureId, lead: Duration) -> Result<Option<Box<Batch>>, Stuck> {
        let max_late = self.settings.max_late;
        let closing = self.writer.call(CloseBatch { departure_id: id, lead, max_late }).await?;
        match closing {
            Closing::Closed(batch) => {
                let (start, requests) = (batch.start, batch.requests.len());
                tracing::info!(departure = %id, %start, requests, "closed");
                Ok(Some(batch))
            }
            Closing::Missed => {
                tracing::warn!(departure = %id, "missed");
                Ok(None)
            }
            Closing::ChargerOut | Closing::Gone => Ok(None),
        }
    }

    /// Plans a batch; none where the departure was called off meanwhile.
    async fn plan(&self, batch: Batch, lead: Duration) -> Result<Option<Planned>, Stuck> {
        let _runs = self.metrics.planning.running.enter();
        let budget = self.settings.budget;
        // A lead that is hardly longer than the budget must not end the search before it begins.
        let spare = lead.saturating_sub(budget);
        let contest = Contest {
            solver: self.settings.solver,
            solve,
            policies: self.policies.current(),
            seed: self.settings.seed,
            budget,
            latest: minus(batch.start, TO_STORE.min(spare / 2)),
            clock: self.clock.clone(),
            cancel: self.cancel.child_token(),
        };
        let (id, cancel) = (batch.departure.id, contest.cancel.clone());
        let span = tracing::info_span!("plan", requests = batch.requests.len());
        let plan = move || span.in_scope(|| planner::plan(&batch, &contest));
        let mut thread = tokio::task::spawn_blocking(plan);
        let planned = tokio::select! {
            planned = &mut thread => planned,
            () = self.called_off(id) => {
                // The search sees it at its next look; the thread is free once it has ended.
                cancel.cancel();
                let _ = thread.await?;
                tracing::info!(departure = %id, "called off while its tour was planned");
                return Ok(None);
            }
        };
        Ok(Some(planned??))
    }

    /// Ends once a departure that is closed is so no more.
    async fn called_off(&self, id: DepartureId) {
        let mut changes = self.writer.tour_changes();
        loop {
            match self.reads.departure(id).await {
                Ok(Some(departure)) if departure.state != DepartureState::Closed => return,
                // What becomes of it is seen at the latest when its plan is to be stored.
                Ok(_) => {}
                Err(error) => tracing::warn!(%error, "a departure that is planned cannot be read"),
            }
            if changes.changed().await.is_err() {
                return std::future::pending().await;
            }
        }
    }

    /// Logs and counts what part the policy had.
    fn tell(&self, departure: DepartureId, policy: &PolicyPart) {
        if let Some((reason, why)) = &policy.fallback {
            self.metrics.planning.policy_fell_back(*reason);
            if policy.used.is_some() {
                tracing::warn!(%departure, %reason, why, "the policy broke down, or built no tour");
            } else {
                // What is wrong with a model was a warning when it was loaded.
                tracing::info!(%departure, %reason, "planned without a policy");
            }
        }
        if let Some(winning) = policy.winning {
            self.metrics.planning.policy_competed(winning);
        }
    }

    /// A batch without any plan is a defect; its requests must not wait for it.
    async fn give_up(&self, id: DepartureId, error: &PlanError) -> Result<(), Stuck> {
        tracing::error!(departure = %id, %error, "a defect: no plan can be made, cancelling");
        let reason = "no plan can be made of its batch".to_owned();
        // An id of the service's own making is one that a client could have made.
        let client_id: Result<ClientId, _> = format!("service:{id}").parse();
        if let Ok(client_id) = client_id {
            let content = CancelDeparture { departure_id: id, reason };
            self.writer.call(Cancel(Call { client_id, content })).await?;
        }
        Ok(())
    }
}
