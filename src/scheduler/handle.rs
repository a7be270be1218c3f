//! The cheap handle that the edges hold: one method a call of `service.md`.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{Notify, watch};

use super::{Limits, Settings, next_tour};
use crate::domain::{
    Announcement, Call, ChargerId, Departure, DepartureId, Network, NetworkId, NewRequest,
    NewVisit, Refusal, Request, Tour, TourId, Visit, rules,
};
use crate::store::{
    Announce, Cancel, Complete, Put, Reads, ReportVisit, Submit, TakeBack, UpdatePaths, Writer,
};

pub use crate::domain::{CancelDeparture, PutNetwork, UpdateTrajectories, Withdraw};

/// To the running scheduler; cheap to clone.
#[derive(Clone, Debug)]
pub struct Handle {
    writer: Writer,
    reads: Reads,
    lead: Duration,
    limits: Limits,
    /// Wakes the scheduler where there may be something to do.
    wake: Arc<Notify>,
}

impl Handle {
    pub(super) fn new(
        writer: Writer,
        reads: Reads,
        settings: &Settings,
        wake: Arc<Notify>,
    ) -> Self {
        Self { writer, reads, lead: settings.lead, limits: settings.limits, wake }
    }

    fn woken<T>(&self, answer: Result<T, Refusal>) -> Result<T, Refusal> {
        if answer.is_ok() {
            self.wake.notify_one();
        }
        answer
    }
}

#[allow(missing_docs)]
impl Handle {
    pub async fn put_network(&self, call: Call<PutNetwork>) -> Result<Network, Refusal> {
        // A large network takes a while to judge and to compress.
        let most = self.limits.networks;
        let put = tokio::task::spawn_blocking(move || {
            rules::network(&call.content.spec)?;
            Put::new(call, most)
        });
        let put = put.await.map_err(|error| Refusal::Internal(error.to_string()))??;
        self.writer.offer(put).await
    }

    pub async fn update_trajectories(
        &self,
        call: Call<UpdateTrajectories>,
    ) -> Result<u32, Refusal> {
        self.writer.offer(UpdatePaths(call)).await
    }

    pub async fn submit(&self, call: Call<NewRequest>) -> Result<Request, Refusal> {
        self.writer.offer(Submit::new(call)).await
    }

    /// [`submit`](Self::submit) in two steps: when this returns, the request's place among the others is
    /// settled; what it returns is the answer.
    pub async fn queue_submit(
        &self,
        call: Call<NewRequest>,
    ) -> Result<impl Future<Output = Result<Request, Refusal>> + Send + use<>, Refusal> {
        self.writer.enqueue_soon(Submit::new(call)).await
    }

    pub async fn withdraw(&self, call: Call<Withdraw>) -> Result<Request, Refusal> {
        self.writer.offer(TakeBack(call)).await
    }

    pub async fn announce(&self, call: Call<Announcement>) -> Result<Departure, Refusal> {
        self.woken(
            self.writer
                .offer(Announce { call, lead: self.lead, most: self.limits.departures })
                .await,
        )
    }

    pub async fn cancel(&self, call: Call<CancelDeparture>) -> Result<Departure, Refusal> {
        self.woken(self.writer.offer(Cancel(call)).await)
    }

    pub async fn report_visit(&self, call: Call<NewVisit>) -> Result<Visit, Refusal> {
        self.writer.offer(ReportVisit(call)).await
    }

    pub async fn complete(&self, call: Call<TourId>) -> Result<Tour, Refusal> {
        self.woken(self.writer.offer(Complete(call)).await)
    }

    /// Waits until the charger's next tour is stored; the caller bounds the wait by dropping the future.
    pub async fn next_tour(
        &self,
        network_id: &NetworkId,
        charger_id: &ChargerId,
        departure_id: Option<DepartureId>,
    ) -> Result<Tour, Refusal> {
        let changes = self.writer.tour_changes();
        next_tour::wait(&self.reads, changes, network_id, charger_id, departure_id).await
    }

    /// For `Get` and `List`, and for what a watch reads after it was woken.
    pub fn reads(&self) -> &Reads {
        &self.reads
    }

    /// The number of the last committed change; wakes watches. Each row that changes has a number of
    /// its own. It closes when the service ends.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.writer.changes()
    }
}
