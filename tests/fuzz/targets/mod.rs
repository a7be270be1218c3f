//! The fuzz targets: what reads bytes from outside, each as one function. A target panics where something is wrong, and
//! says otherwise whether the bytes were taken, so that a seed that is no good any more is noticed.
//!
//! Two drivers run them: `tests/fuzz` for a moment in CI, from the seeds and without chance; `fuzz/` with
//! libFuzzer, for as long as one likes.

mod cursor;
mod message;
mod policy;
mod query;
mod raw;
mod scenario;
mod service;

pub use cursor::cursor;
pub use message::message;
pub use policy::policy;
pub use query::query;
pub use scenario::scenario;
