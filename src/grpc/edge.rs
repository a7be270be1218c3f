//! What the four services share.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_util::sync::CancellationToken;

use crate::access::Gate;
use crate::domain::Refusal;
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
    streams: Arc<Semaphore>,
}

impl Edge {
    /// On the handle of a running scheduler, behind the gate.
    pub fn new(handle: Handle, gate: Gate, limits: Limits, stop: CancellationToken) -> Self {
        let streams = Arc::new(Semaphore::new(limits.streams));
        Self { handle, gate, limits, stop, streams }
    }

    /// Room for one more stream, for as long as the permit lives.
    pub(super) fn stream_permit(&self) -> Result<OwnedSemaphorePermit, Refusal> {
        self.streams.clone().try_acquire_owned().map_err(|_| {
            let most = self.limits.streams;
            Refusal::ResourceExhausted(format!("{most} streams are open, the most at once"))
        })
    }
}
