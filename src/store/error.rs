//! What can go wrong below the service.

use std::path::PathBuf;

/// What can go wrong below the service.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The database said so.
    #[error("database: {0}")]
    Database(#[from] sqlx::Error),
    /// A row holds what no row should hold.
    #[error("row of {table} cannot be read: {reason}")]
    Row {
        /// The table.
        table: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// Another process has the database open.
    #[error("{} is in use by another process", .0.display())]
    InUse(PathBuf),
    /// There is no database.
    #[error("{}: there is no database", .0.display())]
    Missing(PathBuf),
    /// A service of an earlier version has the database open.
    #[error("{}: a service of an earlier version runs on it; start it again with this version", .0.display())]
    Older(PathBuf),
    /// There are as many as there may be.
    #[error("there are {most} {what}, the most at once")]
    Full {
        /// What there are so many of.
        what: &'static str,
        /// How many.
        most: i64,
    },
    /// The lock file cannot be made.
    #[error("lock file {}: {source}", path.display())]
    Lock {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The schema could not be brought up to date.
    #[error("migration: {0}")]
    Migration(#[from] sqlx::migrate::MigrateError),
    /// A task of the service ended as it should not.
    #[error("task: {0}")]
    Task(String),
    /// The database does not hold what it held.
    #[error("verification: {0}")]
    Verification(String),
}

impl StoreError {
    /// Whether others were in the way: so many read at once that there was no connection in time.
    pub fn is_busy(&self) -> bool {
        matches!(self, Self::Database(sqlx::Error::PoolTimedOut))
    }

    pub(super) fn row(table: &'static str, reason: impl ToString) -> Self {
        Self::Row { table, reason: reason.to_string() }
    }
}
