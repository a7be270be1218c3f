//! The writer: the one task that changes the database. It takes what has queued up, applies it in one
//! transaction, commits, and only then answers each.

mod job;
mod tally;
mod task;
#[cfg(test)]
mod tests;
mod writing;

pub(crate) use job::{Command, Failure};
pub(crate) use task::Task;
pub use task::Writer;
pub(super) use task::spawn;
pub(crate) use writing::Writing;
