//! The names of the solvers, as the command line spells them.

use std::fmt;
use std::str::FromStr;

/// A solver by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SolverName {
    /// What the service runs: the best of several.
    Auto,
    /// The trained policy.
    Dqn,
    /// Construction and local search.
    Baseline,
    /// Proves its tour.
    Exact,
    /// Cheapest feasible insertion, what cannot wait first.
    Greedy,
    /// The paper's greedy: always the nearest sensor that helps.
    Nearest,
    /// The paper's random walk, many times.
    Random,
    /// Ant colony system.
    Acs,
    /// Dynamic programming over colourful paths of the time-discretised graph.
    Dp,
    /// Minimum spanning tree.
    Mst,
    /// Capacitated minimum spanning tree.
    Cmst,
    /// The approximation algorithm of the scenario's problem.
    App,
}

impl SolverName {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Auto,
        Self::Dqn,
        Self::Baseline,
        Self::Exact,
        Self::Greedy,
        Self::Nearest,
        Self::Random,
        Self::Acs,
        Self::Dp,
        Self::Mst,
        Self::Cmst,
        Self::App,
    ];

    /// The name on the command line and in a plan.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Dqn => "dqn",
            Self::Baseline => "baseline",
            Self::Exact => "exact",
            Self::Greedy => "greedy",
            Self::Nearest => "nearest",
            Self::Random => "random",
            Self::Acs => "acs",
            Self::Dp => "dp",
            Self::Mst => "mst",
            Self::Cmst => "cmst",
            Self::App => "app",
        }
    }
}

impl fmt::Display for SolverName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// No solver has that name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown solver \"{0}\"")]
pub struct UnknownSolver(pub String);

impl FromStr for SolverName {
    type Err = UnknownSolver;

    fn from_str(name: &str) -> Result<Self, UnknownSolver> {
        let found = Self::ALL.into_iter().find(|solver| solver.name() == name);
        found.ok_or_else(|| UnknownSolver(name.to_owned()))
    }
}
