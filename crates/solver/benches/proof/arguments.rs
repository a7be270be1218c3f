//! What the command line asks for.

use std::error::Error;

use voltour_solver::solvers::SolverName;

/// The options, each with a default.
pub struct Arguments {
    /// Seconds that CP-SAT has for each scenario.
    pub limit_s: f64,
    /// Seconds that ours has for each.
    pub solver_limit_s: f64,
    /// Scenarios whose name contains it.
    pub only: String,
    /// Which of our solvers; one that proves nothing shows whether the values agree.
    pub solver: SolverName,
}

impl Arguments {
    /// Reads `--name value` pairs; `--bench`, which cargo adds, says nothing.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, Box<dyn Error>> {
        let mut limit_s = 60.0;
        let mut solver_limit_s = None;
        let mut only = String::new();
        let mut solver = SolverName::Exact;
        while let Some(word) = words.next() {
            if word == "--bench" {
                continue;
            }
            let mut value = || words.next().ok_or_else(|| format!("{word} lacks its value"));
            match word.as_str() {
                "--limit" => limit_s = seconds(&value()?)?,
                "--solver-limit" => solver_limit_s = Some(seconds(&value()?)?),
                "--only" => only = value()?,
                "--solver" => solver = value()?.parse()?,
                _ => {
                    return Err(format!(
                        "{word} is none of --limit, --solver-limit, --only, --solver"
                    )
                    .into());
                }
            }
        }
        Ok(Self { limit_s, solver_limit_s: solver_limit_s.unwrap_or(limit_s), only, solver })
    }
}

fn seconds(text: &str) -> Result<f64, Box<dyn Error>> {
    let seconds: f64 = text.parse()?;
    if !(seconds.is_finite() && seconds > 0.0) {
        return Err(format!("{text} is no number of seconds above 0").into());
    }
    Ok(seconds)
}
