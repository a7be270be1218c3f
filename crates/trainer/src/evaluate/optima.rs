//! [`Optima`]: what the exact solver has proven of each scenario, kept in a file, for proofs are dear.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use cpu_time::ThreadTime;
use voltour_solver::instance::Instance;
use voltour_solver::plan::Status;
use voltour_solver::solvers::{Options, SolverName, solve_compiled};
use voltour_solver::stop::Limit;

use crate::stopwatch::Stopwatch;

/// The reference of a scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimum {
    /// Best objective known; `None` if no feasible tour was found.
    pub objective: Option<f64>,
    /// Whether that is proven.
    pub proven: bool,
}

/// References by the name of cell and seed.
#[derive(Debug)]
pub struct Optima {
    file: Option<PathBuf>,
    known: BTreeMap<String, Optimum>,
    limit_s: f64,
}

impl Optima {
    /// What a file of earlier proofs holds; a file that is not there holds nothing.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn open(file: Option<&Path>, limit_s: f64) -> io::Result<Self> {
        let text = match file.map(fs::read_to_string) {
            None => String::new(),
            Some(Err(error)) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Some(text) => text?,
        };
        let known = text.lines().filter_map(row).collect();
        Ok(Self { file: file.map(Path::to_owned), known, limit_s })
    }

    /// The reference of a scenario, looked up or found within the limit of processor time.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn of(&mut self, key: &str, instance: &Instance<'_>) -> io::Result<Optimum> {
        if let Some(&known) = self.known.get(key) {
            return Ok(known);
        }
        let begin = ThreadTime::now();
        let watch = Stopwatch::start();
        let spent = || begin.elapsed().as_secs_f64();
        let stop = Limit::new(self.limit_s, spent, || watch.seconds());
        let options = Options { solver: SolverName::Exact, seed: 0, stop: &stop, policy: None };
        // The exact solver is part of every version.
        let solved = solve_compiled(instance, &options).map_err(io::Error::other)?;
        let plan = solved.plan;
        let found = Optimum {
            objective: plan.status.is_feasible().then_some(plan.objective),
            proven: matches!(plan.status, Status::Optimal | Status::Infeasible),
        };
        self.known.insert(key.to_owned(), found);
        if let Some(file) = &self.file {
            let mut file = fs::OpenOptions::new().create(true).append(true).open(file)?;
            let objective = found.objective.map_or_else(String::new, |f| f.to_string());
            writeln!(file, "{key},{objective},{}", found.proven)?;
        }
        Ok(found)
    }
}

fn row(line: &str) -> Option<(String, Optimum)> {
    let mut cells = line.split(',');
    let (key, objective, proven) = (cells.next()?, cells.next()?, cells.next()?);
    let objective = if objective.is_empty() { None } else { Some(objective.parse().ok()?) };
    Some((key.to_owned(), Optimum { objective, proven: proven.parse().ok()? }))
}
