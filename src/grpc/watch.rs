//! Watches: the present state first, then every change, none missed.
//!
//! A watch holds no queue of changes. It is woken by the number of the last commit and reads what
//! changed since the last change that it has sent; a slow client makes it read later, not hold more.

use std::collections::VecDeque;
use std::future::Future;
use std::time::Duration;

use futures_util::stream::{self, Stream};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;
use tonic::Status;

use super::Edge;
use super::edge::Permit;
use super::status::{read_failed, stopping};
use crate::domain::{NetworkId, Refusal};
use crate::store::{Reads, StoreError};

/// Rows read at a time.
const PAGE: u32 = 500;

/// Under load commits come by the hundred a second: a watch reads once for those of so long.
const GATHER: Duration = Duration::from_millis(10);

/// What a watch can follow.
pub(super) trait Followed: Sized + Send + 'static {
    /// What is sent of it.
    type Message: Send + 'static;

    /// What is alive now, and the change it was read at.
    fn live(
        reads: &Reads,
        network: &NetworkId,
    ) -> impl Future<Output = Result<(Vec<Self>, u64), StoreError>> + Send;

    /// What changed after `change`, in the order of its change.
    fn since(
        reads: &Reads,
        network: &NetworkId,
        change: u64,
        limit: u32,
    ) -> impl Future<Output = Result<Vec<Self>, StoreError>> + Send;

    /// The number of its last change.
    fn change(&self) -> u64;

    /// As it is sent.
    fn message(self, initial: bool) -> Self::Message;
}

/// The messages of a watch on a network; only those that `wanted` lets pass.
pub(super) async fn follow<T: Followed>(
    edge: &Edge,
    network: NetworkId,
    wanted: impl Fn(&T) -> bool + Send + 'static,
) -> Result<impl Stream<Item = Result<T::Message, Status>> + Send + 'static, Refusal> {
    let permit = edge.stream_permit()?;
    let reads = edge.handle.reads().clone();
    let known = reads.network(&network).await.map_err(read_failed)?;
    if known.is_none() {
        return Err(Refusal::NotFound { what: "network", id: network.into() });
    }
    // Subscribed before the present state is read: a commit between the two wakes the watch.
    let changes = edge.handle.changes();
    let (live, last) = T::live(&reads, &network).await.map_err(read_failed)?;
    let queue = live.into();
    let stop = edge.stop.clone();
    let watch = Watch {
        reads,
        network,
        changes,
        stop,
        last,
        queue,
        initial: true,
        wanted,
        _permit: permit,
    };
    Ok(stream::try_unfold(watch, |mut watch| async move {
        let message = watch.next().await?;
        Ok(Some((message, watch)))
    }))
}

struct Watch<T, F> {
    reads: Reads,
    network: NetworkId,
    changes: watch::Receiver<u64>,
    stop: CancellationToken,
    /// Every change up to it was sent or is in the queue.
    last: u64,
    queue: VecDeque<T>,
    /// Whether the queue is of the present state.
    initial: bool,
    wanted: F,
    _permit: Permit,
}

impl<T: Followed, F: Fn(&T) -> bool> Watch<T, F> {
    async fn next(&mut self) -> Result<T::Message, Status> {
        loop {
            if self.stop.is_cancelled() {
                return Err(stopping());
            }
            while let Some(item) = self.queue.pop_front() {
                if (self.wanted)(&item) {
                    return Ok(item.message(self.initial));
                }
            }
            self.initial = false;
            if *self.changes.borrow_and_update() > self.last {
                self.read().await.map_err(read_failed)?;
            } else {
                self.sleep().await?;
            }
        }
    }

    /// Reads the next changes. Rows of one transaction may share its number: a page that ends within
    /// one goes back to the transaction before, and a transaction longer than a page is read whole.
    async fn read(&mut self) -> Result<(), StoreError> {
        let seen = *self.changes.borrow();
        let mut limit = PAGE;
        loop {
            let mut page = T::since(&self.reads, &self.network, self.last, limit).await?;
            let whole = page.len() < limit as usize;
            let end = page.last().map_or(seen, T::change);
            if !whole {
                page.retain(|item| item.change() < end);
            }
            match page.last().map(T::change) {
                _ if whole => self.last = self.last.max(seen).max(end),
                Some(change) => self.last = change,
                // `seen` may be behind the rows by now, and so decides nothing here.
                None => {
                    limit = limit.saturating_mul(2);
                    continue;
                }
            }
            self.queue = page.into();
            return Ok(());
        }
    }

    async fn sleep(&mut self) -> Result<(), Status> {
        tokio::select! {
            () = self.stop.cancelled() => return Err(stopping()),
            // Without its sender the store is closed.
            changed = self.changes.changed() => changed.map_err(|_| stopping())?,
        }
        tokio::time::sleep(GATHER).await;
        Ok(())
    }
}
