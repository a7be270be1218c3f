//! [`Problem`]: for which scenarios a policy is trained.

use std::fmt;
use std::str::FromStr;

use crate::scenario::Objective;

/// One of the paper's three problems; a policy is trained for one of them. It follows from the objective alone:
/// whichever constraints a scenario combines with it, they are in the features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Problem {
    /// The shortest tour that keeps the demands.
    KCoverage,
    /// The most reward within the budget of energy.
    Reward,
    /// The most sensors, moving, within the span of time.
    Mobile,
}

impl Problem {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::KCoverage, Self::Reward, Self::Mobile];

    /// The problem of the scenarios with this objective.
    pub const fn of(objective: Objective) -> Self {
        match objective {
            Objective::MinDistance => Self::KCoverage,
            Objective::MaxReward => Self::Reward,
            Objective::MaxCount => Self::Mobile,
        }
    }

    /// The name on the command line, in a model's metadata and of its file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::KCoverage => "k_coverage",
            Self::Reward => "reward",
            Self::Mobile => "mobile",
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// No problem has that name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown problem {0:?}; known: k_coverage, reward, mobile")]
pub struct UnknownProblem(pub String);

impl FromStr for Problem {
    type Err = UnknownProblem;

    fn from_str(name: &str) -> Result<Self, UnknownProblem> {
        let found = Self::ALL.into_iter().find(|problem| problem.name() == name);
        found.ok_or_else(|| UnknownProblem(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_back_and_no_other() {
        for problem in Problem::ALL {
            assert_eq!(problem.name().parse(), Ok(problem));
        }
        let error = "k-coverage".parse::<Problem>().unwrap_err();
        assert!(Problem::ALL.iter().all(|problem| error.to_string().contains(problem.name())));
    }
}
