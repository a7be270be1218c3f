//! [`Winning`]: whose tour was the best, where the policy had built one.

use voltour_solver::solvers::SolverName;

/// Whose tour was the best, where the policy had built one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Winning {
    /// The policy's.
    Policy,
    /// One that was constructed without it.
    Baseline,
    /// Another solver's, such as a proof's.
    Other,
}

impl Winning {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Policy, Self::Baseline, Self::Other];

    /// Whose tour one of this solver is.
    pub fn of(solver: &str) -> Self {
        match solver.parse() {
            Ok(SolverName::Dqn) => Self::Policy,
            Ok(SolverName::Baseline | SolverName::Greedy) => Self::Baseline,
            _ => Self::Other,
        }
    }

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Policy => "policy",
            Self::Baseline => "baseline",
            Self::Other => "other",
        }
    }
}
