//! How good a policy is: gaps to proven optima, cell by cell, beside the same search without learning.

mod method;
mod optima;
mod paired;
mod table;

pub use method::{METHODS, Method, Run, UnknownMethod};
pub use optima::{Optima, Optimum};
pub use paired::Paired;
pub use table::{Summary, Table};

#[cfg(test)]
mod tests;
