//! The store: the only room that sees SQL.

mod open;
mod page;
mod read;

pub use open::Store;
pub use page::{DepartureFilter, Listed, Page, PlanFilter, RequestFilter};
pub use read::{PlanSummary, Reads};

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
}
