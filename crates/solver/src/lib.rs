//! The pure core of voltour: a scenario in, a checked charging tour out.

pub mod check;
pub mod coverage;
pub mod generate;
pub mod instance;
pub mod local_search;
pub mod plan;
pub mod scenario;
pub mod solvers;
pub mod stop;
pub mod tolerance;
pub mod tour;

/// The tests share files with the integration tests, which know the crate by its name.
#[cfg(test)]
extern crate self as voltour_solver;
