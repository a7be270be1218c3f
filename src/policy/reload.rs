//! Loading the models again when an operator asks for it.

use tokio::signal::unix::Signal;
use tokio_util::sync::CancellationToken;
use voltour_solver::policy::Problem;

use super::{Reloaded, Shelf};

/// Loads the models again at every SIGHUP, until `stop`, and tells what became of each.
pub fn reload_on(
    mut hangups: Signal,
    shelf: Shelf,
    stop: CancellationToken,
    tell: impl Fn(Problem, &Reloaded) + Send + 'static,
) {
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
}
