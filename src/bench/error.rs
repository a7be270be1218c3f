//! What ends a bench.

use std::path::{Path, PathBuf};

/// Why a bench cannot go on; what it has measured so far is in its log.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// A file cannot be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file says something else than it should.
    #[error("{}: {problem}", path.display())]
    Content {
        /// Which.
        path: PathBuf,
        /// What, and the rule.
        problem: String,
    },
    /// A scenario cannot be drawn, or is not for a solver.
    #[error("{scenario}: {problem}")]
    Scenario {
        /// Which.
        scenario: String,
        /// What.
        problem: String,
    },
    /// A solver broke a promise: a plan that does not hold, or one better than the proven optimum.
    #[error("defect: {algorithm} on {scenario}: {problem}; please report it")]
    Defect {
        /// On which scenario.
        scenario: String,
        /// Whose.
        algorithm: String,
        /// Which promise.
        problem: String,
    },
    /// A plot cannot be drawn.
    #[error("plot of {table}: {problem}")]
    Plot {
        /// Of which table.
        table: String,
        /// Why not.
        problem: String,
    },
}

impl BenchError {
    /// For `map_err`: what went wrong with a file.
    pub fn file(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        |source| Self::File { path: path.to_owned(), source }
    }

    /// What is wrong in a file.
    pub fn content(path: &Path, problem: impl std::fmt::Display) -> Self {
        Self::Content { path: path.to_owned(), problem: problem.to_string() }
    }

    /// Whether bad input is to blame.
    pub fn is_input(&self) -> bool {
        matches!(self, Self::File { .. } | Self::Content { .. } | Self::Scenario { .. })
    }
}
