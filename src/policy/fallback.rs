//! [`Fallback`]: why a tour was planned without the policy, as the metrics and the provenance spell it.

use std::fmt;

use voltour_solver::policy::QError;

use super::Fault;

/// Why a tour was planned without the policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fallback {
    /// There is none for the problem.
    NoModel,
    /// Its file cannot be read, is no ONNX, or does not run.
    Damaged,
    /// It takes the features of another version.
    WrongVersion,
    /// It is trained for another problem.
    WrongProblem,
    /// Its inputs or outputs are not those of the contract.
    WrongShape,
    /// It yields NaN or an infinity.
    NotFinite,
    /// It took more than its share of the time.
    TooSlow,
    /// It built no feasible tour.
    NoTour,
    /// It broke down in another way.
    Failed,
}

impl Fallback {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::NoModel,
        Self::Damaged,
        Self::WrongVersion,
        Self::WrongProblem,
        Self::WrongShape,
        Self::NotFinite,
        Self::TooSlow,
        Self::NoTour,
        Self::Failed,
    ];

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoModel => "no_model",
            Self::Damaged => "damaged",
            Self::WrongVersion => "wrong_version",
            Self::WrongProblem => "wrong_problem",
            Self::WrongShape => "wrong_shape",
            Self::NotFinite => "not_finite",
            Self::TooSlow => "too_slow",
            Self::NoTour => "no_tour",
            Self::Failed => "failed",
        }
    }
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl From<&Fault> for Fallback {
    fn from(fault: &Fault) -> Self {
        match fault {
            Fault::Missing => Self::NoModel,
            Fault::Unreadable(_) | Fault::Damaged(_) => Self::Damaged,
            Fault::WrongVersion { .. } => Self::WrongVersion,
            Fault::WrongProblem { .. } => Self::WrongProblem,
            Fault::WrongShape { .. } => Self::WrongShape,
            Fault::NotFinite(_) => Self::NotFinite,
        }
    }
}

impl From<&QError> for Fallback {
    fn from(error: &QError) -> Self {
        match error {
            QError::NotFinite(_) => Self::NotFinite,
            QError::TooSlow => Self::TooSlow,
            QError::Failed(_) | QError::WrongSize { .. } => Self::Failed,
        }
    }
}
