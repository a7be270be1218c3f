//! Proof: the best tour with a bound that shows it, or that there is none.

mod verdict;

pub use verdict::{Verdict, decide};
