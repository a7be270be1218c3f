//! What can go wrong while a policy is trained, evaluated or exported.

use std::io;
use std::path::{Path, PathBuf};

/// The result of what can fail here.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a policy was not trained, evaluated or exported.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file is no model, or no checkpoint, of ours.
    #[error("{}: {reason}", path.display())]
    Format {
        /// Which.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// An option has no meaning.
    #[error("{name} = {value} {rule}")]
    Option {
        /// Its name on the command line.
        name: &'static str,
        /// What was given.
        value: String,
        /// What it has to hold.
        rule: &'static str,
    },
    /// A number of the training is NaN or infinite: a rate too high, or a broken feature.
    #[error("{what} is not finite at step {step}")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// The gradient step.
        step: u64,
    },
    /// A scenario cannot be drawn or read.
    #[error("scenario: {0}")]
    Scenario(String),
    /// The device that the option names is not part of this build, or cannot compute.
    #[error("device: {0}")]
    Device(String),
    /// A learning curve cannot be drawn.
    #[error("learning curve: {0}")]
    Curve(String),
}

impl Error {
    /// The error of an operation on the file at `path`.
    pub fn file(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::File { path, source }
    }

    /// The file at `path` does not hold what it should.
    pub fn format(path: &Path, reason: impl ToString) -> Self {
        Self::Format { path: path.to_owned(), reason: reason.to_string() }
    }
}
