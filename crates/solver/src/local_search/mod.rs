//! Local search on the order of a tour: one move a file, each named as in the literature.
//!
//! A move is filtered by the length it saves, in constant time, before its schedule is looked at; it is
//! made only if the tour stays legal and takes less of the scarce resource.

mod descend;
mod neighbours;
mod or_opt;
mod repair;
mod splice;
mod two_opt;

pub use descend::descend;
pub use neighbours::Neighbours;
pub use repair::squeeze;
pub use splice::effort;
