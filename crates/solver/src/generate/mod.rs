//! Random scenarios, drawn as in the paper's simulation settings: one kind for each preset.
//!
//! The same options and seed give the same document for good: draws are made from the generator's
//! raw bits here, and every number is rounded to a millionth of its unit.

mod cell;
mod draw;
mod error;
mod k_coverage;
mod mobile;
mod options;
mod reward;

pub use cell::{Cell, FIRST_TEST_SEED, UnknownCell};
pub use error::GenerateError;
pub use k_coverage::{KCoverage, k_coverage};
pub use mobile::{Mobile, mobile};
pub use reward::{Reward, reward};
