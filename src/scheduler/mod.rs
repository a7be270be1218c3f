//! The scheduler: everything that changes something goes through its [`Handle`].

mod handle;

pub use handle::{CancelDeparture, Handle, PutNetwork, UpdateTrajectories, Withdraw};
