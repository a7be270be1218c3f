//! The store: the only room that sees SQL. One [`Writer`] changes the database, in transactions of all
//! that has queued up; [`Reads`] reads beside it.

mod cells;
mod census;
mod commands;
mod copy;
mod error;
mod explanations;
#[cfg(test)]
pub(crate) mod fixture;
mod lock;
mod networks;
mod open;
mod page;
#[cfg(test)]
mod power_loss;
mod read;
mod rows;
mod schema;
mod token_file;
mod tokens;
mod trouble;
mod words;
mod writer;

pub(crate) use cells::pack;
pub use census::Census;
pub use commands::{
    Announce, Attempt, Batch, BeginExplanation, Cancel, CloseBatch, Closing, Complete,
    EndExplanation, Forget, Forgotten, NewPlan, NewStop, Overdue, Put, ReportVisit, StorePlan,
    Storing, Submit, TakeBack, UpdatePaths,
};
pub use copy::{Restored, Verified, backup, restore};
pub use error::StoreError;
pub use explanations::Explained;
pub use open::Store;
pub use page::{DepartureFilter, Listed, Page, PlanFilter, RequestFilter};
pub use read::{PlanSummary, Reads, Waiting};
pub use token_file::TokenFile;
pub use tokens::{Keys, TokenCount};
pub use trouble::Trouble;
pub use writer::Writer;
