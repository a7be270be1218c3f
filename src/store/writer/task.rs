//! The loop of the writer, its handle, and what it does when the database fails.

use std::convert::Infallible;
use std::fmt;
use std::future::Future;
use std::sync::Arc;
use std::time::Duration;

use sqlx::SqliteConnection;
use tokio::sync::{mpsc, watch};
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use super::job::{Asked, Command, Job};
use super::writing::Writing;
use crate::clock::{Clock, Ids, unix_s};
use crate::domain::Refusal;
use crate::metrics::WriterMetrics;
use crate::store::open::{self, Database};
use crate::store::{Reads, StoreError, Trouble};

/// Commands that may wait for the writer.
pub(super) const QUEUE: usize = 4_096;
/// A caller from outside waits so long for room among them.
const ROOM: Duration = Duration::from_secs(1);
/// Commands in one transaction at most.
const GROUP: usize = 1_000;
/// How often a database that is damaged is looked at before the writer gives up.
const LOOKS: u32 = 3;
/// The first wait after a database that failed could not be opened again; each is twice the one before.
const FIRST_PAUSE: Duration = Duration::from_millis(50);
/// And the longest.
const LONGEST_PAUSE: Duration = Duration::from_secs(10);
/// Nobody is refused for a trouble that is over sooner.
const BRIEF: Duration = Duration::from_secs(1);

/// The handle of the writer; cheap to clone.
#[derive(Clone)]
pub struct Writer {
    queue: mpsc::Sender<Box<dyn Job>>,
    committed: watch::Receiver<u64>,
    tours: watch::Receiver<u64>,
    metrics: WriterMetrics,
}

impl fmt::Debug for Writer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Writer").finish_non_exhaustive()
    }
}

impl Writer {
    /// Applies a command; its answer comes after the commit. Waits while the queue is full: for the service's own
    /// commands, of which there are few.
    pub(crate) async fn call<C: Command>(&self, command: C) -> Result<C::Answer, Refusal> {
        self.enqueue(command).await?.await
    }

    /// Queues a command, and waits while the queue is full. When this returns, the command's place among
    /// the others is settled; what it returns is the answer, which comes after the commit.
    pub(crate) async fn enqueue<C: Command>(
        &self,
        command: C,
    ) -> Result<impl Future<Output = Result<C::Answer, Refusal>> + Send + use<C>, Refusal> {
        let closed = || Refusal::Unavailable("the service is shutting down".into());
        let (job, answer) = Asked::new(command, self.metrics.commands.enter());
        self.queue.send(Box::new(job)).await.map_err(|_| closed())?;
        Ok(async move { answer.await.unwrap_or_else(|_| Err(closed())) })
    }

    /// [`call`](Self::call) for callers from outside: they wait for room for a moment, and are refused then.
    pub(crate) async fn offer<C: Command>(&self, command: C) -> Result<C::Answer, Refusal> {
        self.enqueue_soon(command).await?.await
    }

    /// [`enqueue`](Self::enqueue) for callers from outside.
    pub(crate) async fn enqueue_soon<C: Command>(
        &self,
        command: C,
    ) -> Result<impl Future<Output = Result<C::Answer, Refusal>> + Send + use<C>, Refusal> {
        let queued = tokio::time::timeout(ROOM, self.enqueue(command)).await;
        queued.map_err(|_| {
            let reason = format!("{QUEUE} commands wait for the database, the most at once");
            Refusal::exhausted("the queue of the database", reason)
        })?
    }

    /// How many commands more may wait.
    #[cfg(test)]
    pub(super) fn room(&self) -> usize {
        self.queue.capacity()
    }

    /// What it counts.
    pub fn metrics(&self) -> &WriterMetrics {
        &self.metrics
    }

    /// The number of the last committed change.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.committed.clone()
    }

    /// The number of the last committed change of a departure or a tour.
    pub fn tour_changes(&self) -> watch::Receiver<u64> {
        self.tours.clone()
    }
}

/// The task of the writer.
#[derive(Debug)]
pub(crate) struct Task {
    /// Cancelled, the queue closes: what is in it is still done.
    pub stop: CancellationToken,
    /// Ends after the queue has, or when the database cannot be brought back.
    pub ended: JoinHandle<Result<(), StoreError>>,
}

/// Starts the writer.
pub(in crate::store) fn spawn(
    database: Database,
    conn: SqliteConnection,
    change: u64,
    clock: Arc<dyn Clock>,
    reads: Reads,
    trouble: watch::Sender<Option<Trouble>>,
    ids: Ids,
) -> (Writer, Task) {
    let (queue, jobs) = mpsc::channel(QUEUE);
    let (committed, tours) = (watch::Sender::new(change), watch::Sender::new(change));
    let metrics = WriterMetrics::default();
    let writer = Writer {
        queue,
        committed: committed.subscribe(),
        tours: tours.subscribe(),
        metrics: metrics.clone(),
    };
    let stop = CancellationToken::new();
    let writing = Writing::new(conn, change, clock, ids);
    let stopped = stop.clone();
    let work = Work { database, jobs, committed, tours, trouble, reads, metrics, stop: stopped };
    (writer, Task { stop, ended: tokio::spawn(work.run(writing)) })
}

struct Work {
    database: Database,
    jobs: mpsc::Receiver<Box<dyn Job>>,
    committed: watch::Sender<u64>,
    tours: watch::Sender<u64>,
    trouble: watch::Sender<Option<Trouble>>,
    reads: Reads,
    metrics: WriterMetrics,
    stop: CancellationToken,
}

/// How a transaction failed.
enum Fault {
    /// A command broke it, and it was rolled back: the others can be applied without that one.
    Command(StoreError),
    /// The database did: nobody knows what it holds.
    Database(StoreError),
}

impl Work {
    async fn run(mut self, mut writing: Writing) -> Result<(), StoreError> {
        let mut group = Vec::with_capacity(GROUP);
        while self.next(&mut group).await {
            let span = tracing::debug_span!("transaction", commands = group.len());
            let fault = match self.attempt(&mut group, &mut writing).instrument(span).await {
                Ok(()) => {
                    group.drain(..).for_each(Job::answer);
                    continue;
                }
                Err(Fault::Command(error)) => self.singly(&mut group, &mut writing, error).await,
                Err(Fault::Database(error)) => Err(error),
            };
            if let Err(error) = fault {
                self.metrics.failed();
                let trouble = Trouble::of(&error).unwrap_or(Trouble::Failing);
                tracing::error!(%error, %trouble, commands = group.len(), "a transaction failed, reopening the database");
                group.drain(..).for_each(|job| job.refuse(trouble.refusal()));
                writing = self.recover(writing, trouble).await?;
            }
        }
        self.reads.close().await;
        open::close(writing.conn).await
    }

    /// Waits for commands and takes what has queued up; false once the queue is closed and empty.
    async fn next(&mut self, group: &mut Vec<Box<dyn Job>>) -> bool {
        tokio::select! {
            biased;
            () = self.stop.cancelled(), if !self.jobs.is_closed() => self.jobs.close(),
            taken = self.jobs.recv_many(group, GROUP) => return taken > 0,
        }
        self.jobs.recv_many(group, GROUP).await > 0
    }

    /// Applies commands in one transaction.
    async fn attempt(
        &self,
        group: &mut [Box<dyn Job>],
        writing: &mut Writing,
    ) -> Result<(), Fault> {
        let (before, commands) = (writing.change(), group.len());
        let database = |error: sqlx::Error| Fault::Database(error.into());
        writing.begun();
        sqlx::query("BEGIN IMMEDIATE").execute(&mut writing.conn).await.map_err(database)?;
        for job in group {
            if let Err(error) = job.run(writing).await {
                writing.rolled_back(before);
                if Trouble::of(&error).is_some() {
                    // Perhaps rolled back already; the connection is of no use any more.
                    return Err(Fault::Database(error));
                }
                sqlx::query("ROLLBACK").execute(&mut writing.conn).await.map_err(database)?;
                return Err(Fault::Command(error));
            }
        }
        sqlx::query("COMMIT").execute(&mut writing.conn).await.map_err(database)?;
        self.publish(writing, before);
        let took_s = writing.ran().as_secs_f64();
        self.metrics.committed(commands, took_s, unix_s(writing.clock_now()));
        writing.tally.tell(&self.metrics);
        Ok(())
    }

    /// Applies commands each in a transaction of its own, after one of them has failed.
    async fn singly(
        &self,
        group: &mut Vec<Box<dyn Job>>,
        writing: &mut Writing,
        error: StoreError,
    ) -> Result<(), StoreError> {
        tracing::warn!(%error, commands = group.len(), "a command failed, applying them one by one");
        let mut jobs = std::mem::take(group).into_iter();
        while let Some(job) = jobs.next() {
            let mut single = [job];
            let fault = self.attempt(&mut single, writing).await;
            let [job] = single;
            match fault {
                Ok(()) => job.answer(),
                Err(Fault::Command(error)) => {
                    tracing::error!(%error, "a command failed");
                    job.refuse(refusal(&error));
                }
                Err(Fault::Database(error)) => {
                    group.push(job);
                    group.extend(jobs);
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    fn publish(&self, writing: &Writing, before: u64) {
        let change = writing.change();
        if change > before {
            self.committed.send_replace(change);
            if writing.tours_moved {
                self.tours.send_replace(change);
            }
        }
    }

    /// Opens the database again and verifies it, as often as it takes: room may come back, and locks go.
    /// Whoever asks meanwhile is refused. Only what is damaged stays so.
    async fn recover(
        &mut self,
        writing: Writing,
        mut trouble: Trouble,
    ) -> Result<Writing, StoreError> {
        let acknowledged = *self.committed.borrow();
        let (clock, ids) = writing.closed().await;
        let (mut pause, mut damaged) = (Duration::ZERO, 0);
        // Whoever finds a lock has written nothing.
        let mut is_whole = trouble == Trouble::Locked;
        loop {
            self.trouble.send_replace(Some(trouble));
            let reopening = async {
                clock.pause(pause).await;
                self.database.reopen(acknowledged, &mut is_whole).await
            };
            let refusing = async {
                if pause.is_zero() {
                    clock.pause(BRIEF).await;
                }
                refusing(&mut self.jobs, trouble).await
            };
            let reopened = tokio::select! {
                reopened = reopening => reopened,
                never = refusing => match never {},
                () = self.stop.cancelled() => Err(StoreError::Troubled(trouble)),
            };
            let error = match reopened {
                Ok((conn, change)) => {
                    tracing::info!(change, "the database is open again");
                    self.metrics.reopened();
                    self.committed.send_replace(change);
                    self.tours.send_replace(change);
                    self.trouble.send_replace(None);
                    return Ok(Writing::new(conn, change, clock, ids));
                }
                Err(error) => error,
            };
            trouble = Trouble::of(&error).unwrap_or(Trouble::Failing);
            tracing::error!(%error, %trouble, "the database cannot be reopened");
            damaged += u32::from(trouble == Trouble::Damaged);
            // It was found whole, and what could not be written since is in the log. A disk that fails is not believed.
            is_whole &= matches!(trouble, Trouble::Full | Trouble::ReadOnly | Trouble::Locked);
            if damaged == LOOKS || self.stop.is_cancelled() {
                self.jobs.close();
                return Err(error);
            }
            pause = (pause * 2).clamp(FIRST_PAUSE, LONGEST_PAUSE);
        }
    }
}

/// Refuses whatever is asked, for as long as it is polled.
async fn refusing(jobs: &mut mpsc::Receiver<Box<dyn Job>>, trouble: Trouble) -> Infallible {
    loop {
        match jobs.recv().await {
            Some(job) => job.refuse(trouble.refusal()),
            None => std::future::pending().await,
        }
    }
}

fn unavailable() -> Refusal {
    Refusal::Unavailable("the database cannot be written now, nothing was stored: try again".into())
}

/// What the caller of a command hears that has failed on its own.
fn refusal(error: &StoreError) -> Refusal {
    match error {
        StoreError::Database(sqlx::Error::Database(inner))
            if inner.is_unique_violation()
                || inner.is_foreign_key_violation()
                || inner.is_check_violation() =>
        {
            Refusal::Internal("the database refused a row: a defect, see the log".into())
        }
        StoreError::Row { .. } => Refusal::Internal("a row cannot be read: see the log".into()),
        _ => unavailable(),
    }
}
