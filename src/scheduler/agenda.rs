//! The scheduler's task: sleeps until a batch is to be closed or a tour is overdue, and sees to it that
//! the departures of a network go one after the other.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tokio::sync::Notify;
use tokio::task::{Id, JoinError, JoinSet};
use tracing::Instrument;

use super::departing::{Departing, Stuck};
use crate::clock::{minus, plus};
use crate::domain::{DepartureId, NetworkId, Refusal};
use crate::store::{Overdue, Reads, StoreError, Waiting};

/// How long a network waits after something went wrong with it, or the whole agenda.
const PAUSE: Duration = Duration::from_secs(1);
/// The agenda is looked at as often as this at least: a clock that was set makes other things due.
const LOOK: Duration = Duration::from_secs(5);

/// The task and what it knows.
pub(super) struct Agenda {
    pub reads: Reads,
    pub departing: Departing,
    pub wake: Arc<Notify>,
    /// Networks of which a departure is under way; or that wait until a time after one got stuck.
    pub busy: HashMap<NetworkId, Option<Timestamp>>,
    pub under_way: JoinSet<Result<(), Stuck>>,
    /// Whose task is which.
    pub tasks: HashMap<Id, (NetworkId, DepartureId)>,
}

impl Agenda {
    /// Runs until it is cancelled, and until what is under way then has ended.
    pub async fn run(mut self) {
        while !self.departing.cancel.is_cancelled() {
            let next = match self.round().await {
                Ok(next) => next,
                Err(error) => {
                    tracing::error!(%error, "the agenda cannot be read or written");
                    Some(plus(self.departing.clock.now(), PAUSE))
                }
            };
            self.sleep(next).await;
        }
        while let Some(ended) = self.under_way.join_next_with_id().await {
            self.ended(ended);
        }
    }

    /// Starts what is due; gives the time at which something else will be.
    async fn round(&mut self) -> Result<Option<Timestamp>, Trouble> {
        let now = self.departing.clock.now();
        // Longer than a pause waits only who was to wait on a clock that was set back since.
        let waits = |until: Timestamp| until > now && until <= plus(now, PAUSE);
        self.busy.retain(|_, until| until.is_none_or(waits));
        let overdue = self.overdue(now).await?;
        let mut next: Vec<Timestamp> = self.busy.values().copied().flatten().collect();
        next.extend(overdue);
        let waiting = self.reads.waiting().await?;
        for of_network in waiting.chunk_by(|a, b| a.network_id == b.network_id) {
            let Some((departure, due)) = self.first(of_network, now) else { continue };
            if self.busy.contains_key(&departure.network_id) {
                continue;
            }
            if due <= now { self.start(departure) } else { next.push(due) }
        }
        Ok(next.into_iter().min())
    }

    /// Gives up the tours of which nothing was heard; the time at which the next one is.
    async fn overdue(&self, now: Timestamp) -> Result<Option<Timestamp>, Trouble> {
        let after = self.departing.settings.overdue_after;
        while let Some((tour_id, heard)) = self.reads.longest_unheard().await? {
            let due = plus(heard, after);
            if due > now || !self.departing.writer.call(Overdue { tour_id, after }).await? {
                return Ok(Some(due.max(plus(now, Duration::from_millis(1)))));
            }
            tracing::warn!(tour = %tour_id, "overdue");
        }
        Ok(None)
    }

    /// The departure of a network to be dealt with first, and when: of those that are due the first by
    /// (t0, id), which is the order of the list. One whose charger has a tour out lets the others go
    /// first, until it is too late for it.
    fn first<'a>(
        &self,
        of_network: &'a [Waiting],
        now: Timestamp,
    ) -> Option<(&'a Waiting, Timestamp)> {
        let settings = &self.departing.settings;
        let due = |departure: &Waiting| {
            let last = minus(plus(departure.t0, settings.max_late), settings.lead);
            let missed = plus(last, Duration::from_micros(1));
            if departure.charger_out { missed } else { departure.closes_at }
        };
        let due = of_network.iter().map(|departure| (departure, due(departure)));
        let first = due.clone().find(|(_, due)| *due <= now);
        first.or_else(|| due.min_by_key(|(_, due)| *due))
    }

    fn start(&mut self, departure: &Waiting) {
        let (network, id) = (departure.network_id.clone(), departure.id);
        self.busy.insert(network.clone(), None);
        let departing = self.departing.clone();
        let span = tracing::info_span!("departure", departure = %id, %network);
        let task = async move { departing.depart(id).await };
        let task = self.under_way.spawn(task.instrument(span));
        self.tasks.insert(task.id(), (network, id));
    }

    async fn sleep(&mut self, next: Option<Timestamp>) {
        let clock = self.departing.clock.clone();
        let cancel = self.departing.cancel.clone();
        let due = async {
            match next {
                Some(next) => clock.sleep_until(next).await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            () = cancel.cancelled() => {}
            () = self.wake.notified() => {}
            Some(ended) = self.under_way.join_next_with_id() => self.ended(ended),
            () = due => {}
            () = clock.pause(LOOK) => {}
        }
    }

    fn ended(&mut self, ended: Result<(Id, Result<(), Stuck>), JoinError>) {
        let (task, trouble) = match ended {
            Ok((task, Ok(()))) => (task, None),
            Ok((task, Err(error))) => (task, Some(error)),
            Err(error) => (error.id(), Some(Stuck::Thread(error))),
        };
        let Some((network, departure)) = self.tasks.remove(&task) else { return };
        match trouble {
            None => {
                self.busy.remove(&network);
            }
            Some(error) => {
                tracing::error!(%network, %departure, %error, "a departure is stuck, trying again");
                let until = plus(self.departing.clock.now(), PAUSE);
                self.busy.insert(network, Some(until));
            }
        }
    }
}

/// Why a round could not be done.
#[derive(Debug, thiserror::Error)]
enum Trouble {
    #[error("{0}")]
    Read(#[from] StoreError),
    #[error("{0}")]
    Write(#[from] Refusal),
}
