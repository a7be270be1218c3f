//! The pure core of voltour: a scenario in, a checked charging tour out.
//!
//! A network of sensors with rechargeable batteries; a charger that drives out and charges them one by
//! one. A [`scenario`] says where everything is, who asks to be charged and what the tour optimises; a
//! [`plan`] answers it. Three steps, and none of them reads a clock, a file or the network:
//!
//! ```
//! use voltour_solver::check::check;
//! use voltour_solver::generate::{k_coverage, KCoverage};
//! use voltour_solver::scenario::Scenario;
//! use voltour_solver::solvers::{solve, Options, SolverName};
//! use voltour_solver::stop::MaxIterations;
//!
//! // 1. A scenario: from a JSON document (`Scenario::from_json`), or drawn as in the paper's simulations.
//! let document = k_coverage(&KCoverage { sensors: 32, k: 2, ..KCoverage::default() }, 7)?;
//! let scenario = Scenario::from_document(&document)?;
//!
//! // 2. A plan: the same scenario, seed and iterations give the same tour, always.
//! let options = Options { solver: SolverName::Auto, seed: 0, stop: &MaxIterations(1_000), policy: None };
//! let plan = solve(&scenario, &options)?.plan;
//! assert!(plan.status.is_feasible());
//!
//! // 3. The proof that it holds: recomputed by code that shares nothing with the search.
//! assert!(check(&scenario, &plan).is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A time limit is a [`stop::StopRule`] that looks at the caller's clock. What a tour cannot do is a value
//! of the plan (its status, its violations, a reason for each unserved request), never an error; errors are for
//! documents that break a rule of the format.
//!
//! The problem and its three classic variants come from X. Li and M. Jin, "A General Framework for Charger
//! Scheduling Optimization Problems" (2020); here they are choices of fields of one model.

pub mod check;
pub mod coverage;
pub mod explain;
pub mod framework;
pub mod gap;
pub mod generate;
pub mod instance;
pub mod local_search;
pub mod plan;
pub mod policy;
pub mod scenario;
pub mod solvers;
pub mod stop;
pub mod tolerance;
pub mod tour;
/// The tests share files with the integration tests, which know the crate by its name.
#[cfg(test)]
extern crate self as voltour_solver;
