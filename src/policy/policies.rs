//! [`Policies`]: of each problem, its policy or why there is none.

use std::path::Path;

use voltour_solver::policy::Problem;

use super::{Fault, ModelError, Policy, source};

/// Of each problem, its policy or why there is none. Never changes: a solve ends with what it began with.
#[derive(Clone, Debug)]
pub struct Policies([Result<Policy, ModelError>; 3]);

impl Policies {
    /// Loads all: the files of a folder, and what is part of the binary for those that are not there.
    pub fn load(folder: Option<&Path>) -> Self {
        Self::new(|problem| match folder {
            Some(folder) => source::folder(folder, problem),
            None => source::embedded(problem),
        })
    }

    /// No policy at all.
    pub fn none() -> Self {
        let file = "none".to_owned();
        Self::new(|_| Err(ModelError { file: file.clone(), fault: Fault::Missing }))
    }

    /// Those of this function.
    pub fn new(policy: impl FnMut(Problem) -> Result<Policy, ModelError>) -> Self {
        Self(Problem::ALL.map(policy))
    }

    /// That of a problem.
    ///
    /// # Errors
    /// Why there is none.
    pub fn of(&self, problem: Problem) -> Result<&Policy, &ModelError> {
        let [k_coverage, reward, mobile] = &self.0;
        match problem {
            Problem::KCoverage => k_coverage,
            Problem::Reward => reward,
            Problem::Mobile => mobile,
        }
        .as_ref()
    }

    /// Each with its problem.
    pub fn iter(&self) -> impl Iterator<Item = (Problem, Result<&Policy, &ModelError>)> {
        Problem::ALL.into_iter().map(|problem| (problem, self.of(problem)))
    }
}
