//! How the service ends: the first signal is soft (finish what runs, begin nothing), the second one, or
//! too long a wait, is hard.

use std::io;
use std::time::Duration;

use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio_util::sync::CancellationToken;

/// The two ends; cheap to clone.
#[derive(Clone, Debug, Default)]
pub struct Lifecycle {
    /// Begin nothing new, finish what runs.
    pub soft: CancellationToken,
    /// Stop now.
    pub hard: CancellationToken,
}

impl Lifecycle {
    /// Listens for SIGTERM and SIGINT from now on.
    ///
    /// # Errors
    /// The system refuses the handlers.
    pub fn listen(&self) -> io::Result<()> {
        let (mut term, mut int) =
            (signal(SignalKind::terminate())?, signal(SignalKind::interrupt())?);
        let lifecycle = self.clone();
        tokio::spawn(async move {
            let name = either(&mut term, &mut int).await;
            tracing::info!(signal = name, "stopping; a second signal stops at once");
            lifecycle.soft.cancel();
            let name = either(&mut term, &mut int).await;
            tracing::warn!(signal = name, "stopping at once");
            lifecycle.hard.cancel();
        });
        Ok(())
    }

    /// Ends so long after the first signal.
    pub async fn late(&self, by: Duration) {
        self.soft.cancelled().await;
        tokio::time::sleep(by).await;
    }

    /// Ends when it is time to give up on a soft stop: a second signal, or so long after the first.
    pub async fn given_up(&self, within: Duration) {
        tokio::select! {
            () = self.late(within) => tracing::warn!(?within, "not everything ended in time"),
            () = self.hard.cancelled() => {}
        }
    }
}

async fn either(term: &mut Signal, int: &mut Signal) -> &'static str {
    tokio::select! {
        _ = term.recv() => "SIGTERM",
        _ = int.recv() => "SIGINT",
    }
}
