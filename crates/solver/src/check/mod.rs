//! The independent checker: recomputes a plan from the scenario and the order of its stops alone.
//!
//! It shares the parsed documents with the rest of the crate and nothing else: tolerance, motion
//! and coverage are written here a second time, by other methods, so that a mistake in the search
//! cannot vouch for itself. Where rounding decides a question, the checker accepts either answer.

mod broken;
mod close;
mod cover;
mod limits;
mod motion;
mod numbers;
mod order;
mod replay;
mod status;
mod unserved;
mod verify;
mod violations;

pub use broken::Broken;
pub use verify::check;
