//! Retention: deletes what was over for longer than the configuration says, a portion at a time.

mod task;

pub use task::{Retention, SHORTEST};
