//! Scenarios of one's own.

use std::path::{Path, PathBuf};

use voltour_solver::policy::Problem;
use voltour_solver::scenario::Scenario;

use crate::error::{Error, Result};

/// The scenarios of all `*.json` in a directory, in the order of their names.
///
/// # Errors
/// The directory or a file cannot be read, a document breaks a rule, a scenario is of another problem, or there is
/// none.
pub fn read(directory: &Path, problem: Problem) -> Result<Vec<Scenario>> {
    let entries = std::fs::read_dir(directory).map_err(Error::file(directory))?;
    let mut paths = Vec::new();
    for entry in entries {
        paths.push(entry.map_err(Error::file(directory))?.path());
    }
    paths.retain(|path| path.extension().is_some_and(|e| e == "json"));
    paths.sort();
    let scenario = |path: &PathBuf| {
        let text = std::fs::read(path).map_err(Error::file(path))?;
        let scenario = Scenario::from_json(&text).map_err(|e| Error::format(path, e))?;
        match Problem::of(scenario.objective) {
            its if its == problem => Ok(scenario),
            its => Err(Error::format(path, format!("a scenario of {its}, not of {problem}"))),
        }
    };
    let scenarios: Vec<Scenario> = paths.iter().map(scenario).collect::<Result<_>>()?;
    match scenarios.is_empty() {
        true => Err(Error::Scenario(format!("{} holds no *.json", directory.display()))),
        false => Ok(scenarios),
    }
}
