//! Copies of a database: made beside a running service, checked, and put in its place.

mod backup;
mod durable;
mod restore;
#[cfg(test)]
mod tests;
mod verify;

pub use backup::backup;
pub use restore::{Restored, restore};
pub use verify::Verified;
