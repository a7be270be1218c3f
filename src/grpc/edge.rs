//! What the four services share.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_util::sync::CancellationToken;

use crate::access::Gate;
use crate::domain::Refusal;
use crate::metrics::{Calls, Entered};
use crate::scheduler::Handle;

/// What bounds the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one message.
    pub message_bytes: usize,
    /// Connections at once; further ones wait to be accepted.
    pub connections: usize,
    /// Calls at once on one connection.
    pub calls: u32,
    /// Watches and submission streams at once, over all connections.
    pub streams: usize,
    /// Calls at once, over all connections, but for health checks.
    pub all_calls: usize,
    /// Calls at once that wait for a tour, over all connections.
    pub waits: usize,
    /// Items of one submission stream that are taken and not acknowledged yet.
    pub unacknowledged: usize,
    /// How long a call waits where its caller sets no deadline, and at most.
    pub longest_wait: Duration,
}

/// Implements the services; cheap to clone.
#[derive(Clone, Debug)]
pub struct Edge {
    pub(super) handle: Handle,
    pub(super) gate: Gate,
    pub(super) limits: Limits,
    /// Cancelled when the service stops taking work: streams end.
    pub(super) stop: CancellationToken,
    /// What is counted.
    pub(super) calls: Calls,
    streams: Arc<Semaphore>,
    waits: Arc<Semaphore>,
}

/// Room for a stream or a wait, for as long as it lives.
#[derive(Debug)]
pub(super) struct Permit {
    _room: OwnedSemaphorePermit,
    _open: Entered,
}

impl Edge {
    /// On the handle of a running scheduler, behind the gate.
    pub fn new(
        handle: Handle,
        gate: Gate,
        limits: Limits,
        calls: Calls,
        stop: CancellationToken,
    ) -> Self {
        let room = |most| Arc::new(Semaphore::new(most));
        let (streams, waits) = (room(limits.streams), room(limits.waits));
        Self { handle, gate, limits, calls, stop, streams, waits }
    }

    /// Room for one more stream, for as long as the permit lives.
    pub(super) fn stream_permit(&self) -> Result<Permit, Refusal> {
        let room = self.streams.clone().try_acquire_owned().map_err(|_| {
            let most = self.limits.streams;
            Refusal::exhausted(
                "limits.streams",
                format!("{most} streams are open, the most at once"),
            )
        })?;
        Ok(Permit { _room: room, _open: self.calls.streams.enter() })
    }

    /// Room for one more call that waits, for as long as the permit lives.
    pub(super) fn wait_permit(&self) -> Result<Permit, Refusal> {
        let room = self.waits.clone().try_acquire_owned().map_err(|_| {
            let most = self.limits.waits;
            let reason = format!("{most} calls wait for a tour, the most at once");
            Refusal::exhausted("limits.waits", reason)
        })?;
        Ok(Permit { _room: room, _open: self.calls.waits.enter() })
    }
}
