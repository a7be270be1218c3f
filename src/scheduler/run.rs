//! Starting and ending the scheduler.

use std::collections::HashMap;
use std::sync::Arc;

use tokio::sync::{Notify, Semaphore};
use tokio::task::{JoinHandle, JoinSet};
use tokio_util::sync::CancellationToken;

use super::agenda::Agenda;
use super::departing::Departing;
use super::{Handle, Settings};
use crate::clock::Clock;
use crate::metrics::Metrics;
use crate::policy::Shelf;
use crate::store::{Store, StoreError};

/// The running scheduler and its writer.
#[derive(Debug)]
pub struct Running {
    task: JoinHandle<Result<(), StoreError>>,
}

impl Running {
    /// Waits until everything has ended after the cancellation: the running searches, the queue of the
    /// writer, the last checkpoint. An error is a database that can be written no more; it also comes
    /// without any cancellation.
    ///
    /// # Errors
    /// The database could not be brought back after a failed write.
    pub async fn finished(self) -> Result<(), StoreError> {
        self.task.await.unwrap_or_else(|error| Err(StoreError::Task(error.to_string())))
    }
}

/// Starts the scheduler on a store. It ends when `cancel` is cancelled, or when the database fails for
/// good, and then cancels `cancel` itself. What it finds under way from before is taken up again.
///
/// # Errors
/// The database cannot be read.
pub async fn start(
    store: Store,
    clock: Arc<dyn Clock>,
    settings: Settings,
    policies: Shelf,
    metrics: Metrics,
    cancel: CancellationToken,
) -> Result<(Handle, Running), StoreError> {
    let waiting = store.reads.waiting().await?.len();
    tracing::info!(waiting, "departures that wait for their plan");
    let wake = Arc::new(Notify::new());
    let Store { reads, writer, task: mut writing } = store;
    let handle = Handle::new(writer.clone(), reads.clone(), &settings, wake.clone());
    let planners = Arc::new(Semaphore::new(settings.planner_threads.clamp(1, 256)));
    let departing = Departing {
        writer,
        reads: reads.clone(),
        clock,
        settings,
        policies,
        metrics,
        planners,
        cancel: cancel.clone(),
    };
    let (busy, under_way, tasks) = (HashMap::new(), JoinSet::new(), HashMap::new());
    let agenda = Agenda { reads, departing, wake, busy, under_way, tasks };
    let task = tokio::spawn(async move {
        let agenda = agenda.run();
        tokio::pin!(agenda);
        // The writer ends by itself only when it cannot go on.
        let early = tokio::select! {
            () = &mut agenda => None,
            ended = &mut writing.ended => Some(ended),
        };
        let ended = match early {
            Some(ended) => {
                cancel.cancel();
                agenda.await;
                ended
            }
            None => {
                writing.stop.cancel();
                writing.ended.await
            }
        };
        ended.unwrap_or_else(|error| Err(StoreError::Task(error.to_string())))
    });
    Ok((handle, Running { task }))
}
