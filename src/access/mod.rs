//! Who may do what: tokens are checked here for both edges, against one table of every method and route.
//! Knows of the wire no more than the header that a token comes in.

mod bearer;
mod caller;
mod gate;
mod secret;
pub mod table;

pub use caller::Caller;
pub use gate::Gate;
pub use secret::Secret;
