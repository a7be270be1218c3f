//! Which database a command works on: those that need no service.

use std::path::PathBuf;

use super::Failure;
use crate::config;

/// Which database.
#[derive(Debug, clap::Args)]
pub struct Database {
    /// The database; as the configuration says, or voltour.db, if left out
    #[arg(long, value_name = "FILE", conflicts_with = "config")]
    pub database: Option<PathBuf>,
    /// The service's configuration, which names the database
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
}

impl Database {
    /// Its file.
    pub(super) fn path(&self) -> Result<PathBuf, Failure> {
        if let Some(path) = &self.database {
            return Ok(path.clone());
        }
        let config = config::load(self.config.as_deref());
        Ok(config.map_err(|errors| Failure { code: 2, lines: errors.0 })?.store.path)
    }
}
