//! The scheduler: everything that changes something goes through its [`Handle`].

mod agenda;
mod departing;
mod handle;
mod next_tour;
mod run;
mod settings;
#[cfg(test)]
mod tests;

pub use handle::{CancelDeparture, Handle, PutNetwork, UpdateTrajectories, Withdraw};
pub use run::{Running, start};
pub use settings::{Limits, Settings};
