//! What a client of HTTP/2 has to begin with. Before it has, the server can neither ask whether it is still there nor
//! tell it to go.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use tokio::time::Sleep;
use tokio_util::sync::{CancellationToken, WaitForCancellationFutureOwned};

/// The connection preface (RFC 9113, 3.4).
const PREFACE_BYTES: usize = 24;

/// The wait for the preface.
pub(super) struct Opening {
    missing: usize,
    late: Pin<Box<Sleep>>,
    stopped: Pin<Box<WaitForCancellationFutureOwned>>,
}

impl Opening {
    /// It may take so long, and no longer than until `stop`.
    pub fn new(patience: Duration, stop: CancellationToken) -> Self {
        let late = Box::pin(tokio::time::sleep(patience));
        Self { missing: PREFACE_BYTES, late, stopped: Box::pin(stop.cancelled_owned()) }
    }

    /// So many bytes have come; whether that was all.
    pub fn heard(&mut self, bytes: usize) -> bool {
        self.missing = self.missing.saturating_sub(bytes);
        self.missing == 0
    }

    /// Nothing comes: what a read returns.
    pub fn poll(&mut self, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        if self.stopped.as_mut().poll(cx).is_ready() {
            // As if the client had gone.
            return Poll::Ready(Ok(()));
        }
        self.late.as_mut().poll(cx).map(|()| Err(io::ErrorKind::TimedOut.into()))
    }
}
