//! Starting and ending the scheduler.

use std::sync::Arc;

use tokio_util::sync::CancellationToken;

use super::{Handle, Settings};
use crate::clock::Clock;
use crate::store::{Store, StoreError};

/// The running scheduler and its writer.
#[derive(Debug)]
pub struct Running {}

impl Running {
    /// Waits until everything has ended after the cancellation: the running searches, the queue of the
    /// writer, the last checkpoint. An error is a database that can be written no more; it also comes
    /// without any cancellation.
    ///
    /// # Errors
    /// The database could not be brought back after a failed write.
    pub async fn finished(self) -> Result<(), StoreError> {
        todo!()
    }
}

/// Starts the scheduler on a store. It ends when `cancel` is cancelled, or when the database fails for
/// good, and then cancels `cancel` itself.
///
/// # Errors
/// The database cannot be read.
pub async fn start(
    _store: Store,
    _clock: Arc<dyn Clock>,
    _settings: Settings,
    _cancel: CancellationToken,
) -> Result<(Handle, Running), StoreError> {
    todo!()
}
