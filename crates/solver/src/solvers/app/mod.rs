//! The approximation algorithms that the paper compares with: one where a reward is sought within a
//! capacity, one where moving sensors are counted within a time span.

mod choice;
mod excess;
mod k_path;
mod mobile;
mod orienteering;
mod reward;
mod time_expanded;

pub(super) use choice::{app, app_needs};
