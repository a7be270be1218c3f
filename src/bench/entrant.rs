//! [`Entrant`]: an algorithm with the options under which it takes part.

use std::fmt;

use voltour_solver::solvers::{PaperOptions, SolverName};

/// A solver, and how it differs from its default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entrant {
    /// Which solver.
    pub solver: SolverName,
    /// `nearest` and `random`: any sensor in reach, not only those that help.
    pub literal: bool,
    /// `app` among moving sensors: step of the time, in seconds.
    pub step_s: Option<u32>,
}

impl Entrant {
    /// As it is by default.
    pub const fn plain(solver: SolverName) -> Self {
        Self { solver, literal: false, step_s: None }
    }

    /// To any sensor in reach.
    pub const fn literal(solver: SolverName) -> Self {
        Self { literal: true, ..Self::plain(solver) }
    }

    /// In steps of the time.
    pub const fn stepping(solver: SolverName, step_s: u32) -> Self {
        Self { step_s: Some(step_s), ..Self::plain(solver) }
    }

    /// The options that it stands for.
    pub fn options(&self, memory_bytes: usize) -> PaperOptions {
        let default = PaperOptions::default();
        let app_step_s = self.step_s.map_or(default.app_step_s, f64::from);
        PaperOptions { memory_bytes, literal: self.literal, app_step_s, ..default }
    }

    /// Whether the paper's figures of this solver were measured on it: the paper says nothing of a
    /// literal variant.
    pub fn is_the_papers(&self) -> bool {
        !self.literal
    }
}

/// Its name in logs and tables, such as `nearest-literal` or `app-300`.
impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.solver)?;
        if self.literal {
            f.write_str("-literal")?;
        }
        self.step_s.map_or(Ok(()), |step_s| write!(f, "-{step_s}"))
    }
}
