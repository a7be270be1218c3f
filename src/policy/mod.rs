//! The trained policies: ONNX models that are checked before they are trusted, and run as Q-functions.
//!
//! Three problems, three models. They are part of the binary; a file of a configured folder stands in place of
//! one. Nothing here is needed for a plan: a model that fails a check leaves its problem without a policy, with
//! the reason, and the planner goes on without it. Knows the solver's words for a policy; only `graph` knows the
//! library that runs a model.

mod about;
mod fallback;
mod fault;
mod graph;
mod limited;
mod load;
mod network;
mod pad;
mod policies;
mod probe;
mod reload;
mod shelf;
mod source;
#[cfg(test)]
pub(crate) mod tests;
mod winning;

pub use about::{About, Policy};
pub use fallback::Fallback;
pub use fault::{Fault, ModelError};
pub use limited::Limited;
pub use load::load;
pub use policies::Policies;
pub use reload::reload_on;
pub use shelf::{Reloaded, Shelf};
pub use source::{embedded, file};
pub use winning::Winning;
