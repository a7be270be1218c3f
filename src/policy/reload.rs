//! Loading the models again when an operator asks for it.

use std::io;

use tokio::signal::unix::{SignalKind, signal};
use tokio_util::sync::CancellationToken;
use voltour_solver::policy::Problem;

use super::{Reloaded, Shelf};

/// Loads the models again at every SIGHUP from now on, until `stop`, and tells what became of each.
///
/// # Errors
/// The system refuses the handler.
pub fn on_hangup(
    shelf: Shelf,
    stop: CancellationToken,
    tell: impl Fn(Problem, &Reloaded) + Send + 'static,
) -> io::Result<()> {
    let mut hangups = signal(SignalKind::hangup())?;
    tokio::spawn(async move {
        while stop.run_until_cancelled(hangups.recv()).await.flatten().is_some() {
            tracing::info!(signal = "SIGHUP", "loading the policies again");
            let shelf = shelf.clone();
            match tokio::task::spawn_blocking(move || shelf.reload()).await {
                Ok(became) => became.iter().for_each(|(problem, became)| tell(*problem, became)),
                Err(error) => tracing::error!(%error, "a defect: the policies were not loaded"),
            }
        }
    });
    Ok(())
}
