//! The scheduler: everything that changes something goes through its [`Handle`].

mod handle;
mod run;
mod settings;

pub use handle::{CancelDeparture, Handle, PutNetwork, UpdateTrajectories, Withdraw};
pub use run::{Running, start};
pub use settings::Settings;
