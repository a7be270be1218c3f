//! [`Policy`]: a Q-function and what is known of it.

use std::fmt;
use std::sync::Arc;

use voltour_solver::policy::{Problem, QFunction};

/// What is known of a policy, beside its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct About {
    /// Its name: that of its file, without the extension.
    pub name: String,
    /// Where it came from: a path, or that it is part of the binary.
    pub source: String,
    /// SHA-256 of its file, in hexadecimal.
    pub digest: String,
    /// The problem that it is trained for.
    pub problem: Problem,
    /// The version of the features that it takes.
    pub feature_version: u32,
    /// How it was trained, as its trainer wrote it; empty where it did not.
    pub training: String,
    /// How good it was found, as its trainer wrote it; empty where it did not.
    pub evaluation: String,
}

/// A policy that passed every check; cheap to clone.
#[derive(Clone)]
pub struct Policy {
    /// What is known of it.
    pub about: Arc<About>,
    /// The values of actions.
    pub function: Arc<dyn QFunction>,
}

impl fmt::Debug for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Policy").field("about", &self.about).finish_non_exhaustive()
    }
}
