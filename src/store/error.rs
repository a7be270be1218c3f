//! What can go wrong below the service.

use std::path::{Path, PathBuf};

use super::Trouble;

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
    /// Something else than a database of voltour.
    #[error("it is no database of voltour")]
    Foreign,
    /// A later version made it.
    #[error(
        "its schema has version {found}, and this voltour knows versions up to {known}: a newer voltour made it, \
         run that one or restore a backup from before"
    )]
    Newer {
        /// Its schema's version.
        found: i64,
        /// The latest one known.
        known: i64,
    },
    /// It was not always like this.
    #[error("{} is damaged: {reason}; voltour restore puts a backup in the place of a database", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, as the database says it.
        reason: String,
    },
    /// A file that must not be overwritten.
    #[error("{} is there already; --force replaces it", .0.display())]
    Exists(PathBuf),
    /// A backup over its own database.
    #[error("{} is the database itself", .0.display())]
    Itself(PathBuf),
    /// A database with a log, which is no backup.
    #[error("{} lies beside it: this is the copy of an open database, not a backup made by voltour backup", .0.display())]
    Logged(PathBuf),
    /// A restore that went wrong after it had kept the database from before.
    #[error("{cause}; the database from before is kept as {}", aside.display())]
    SetAside {
        /// Where it lies now.
        aside: PathBuf,
        /// What went wrong.
        cause: Box<StoreError>,
    },
    /// A file cannot be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
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
    /// Nothing can be written, or could be when the service was ended.
    #[error("{0}")]
    Troubled(Trouble),
    /// The database does not hold what it held.
    #[error("verification: {0}")]
    Verification(String),
}

impl StoreError {
    /// Whether others were in the way: so many read at once that there was no connection in time.
    pub fn is_busy(&self) -> bool {
        matches!(self, Self::Database(sqlx::Error::PoolTimedOut))
    }

    /// What a check finds is often several lines; this is one.
    pub(super) fn damaged(path: &Path, reason: impl ToString) -> Self {
        let reason = reason.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        Self::Damaged { path: path.to_owned(), reason }
    }

    pub(super) fn file(path: &Path, source: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), source }
    }

    pub(super) fn row(table: &'static str, reason: impl ToString) -> Self {
        Self::Row { table, reason: reason.to_string() }
    }
}
