//! Opening the database.

use std::path::Path;
use std::sync::Arc;

use super::{Reads, StoreError};
use crate::clock::Clock;

/// An open database: one writer, many readers.
#[derive(Debug)]
pub struct Store {
    /// Its read half.
    pub reads: Reads,
}

impl Store {
    /// Opens the database, makes it where there is none, and brings its schema up to date.
    ///
    /// # Errors
    /// Another process has it open, or it cannot be opened, migrated or verified.
    pub async fn open(_path: &Path, _clock: Arc<dyn Clock>) -> Result<Self, StoreError> {
        todo!()
    }
}
