//! The scenarios of a training: drawn as in the paper's simulations, of mixed sizes, or read from a directory.
//!
//! Training, validation and test draw from disjoint ranges of seeds.

mod draw;
mod mix;
mod read;

pub use draw::{Split, draw};
pub use mix::cells;
pub use read::read;
