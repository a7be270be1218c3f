//! Documents in and out: files, standard input and standard output, each failure as one line.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;

use super::Failure;

/// No document is larger: 1 GiB.
const LARGEST: u64 = 1 << 30;

/// Whether a path stands for standard input, or standard output.
pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads and validates a scenario.
pub(super) fn scenario(path: &Path) -> Result<Scenario, Failure> {
    Scenario::from_json(&read(path)?).map_err(|error| about(path, &error))
}

/// Reads a plan; whether it holds is another question.
pub(super) fn plan(path: &Path) -> Result<Plan, Failure> {
    Plan::from_json(&read(path)?).map_err(|error| about(path, &error))
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let text = if is_standard(path) {
        limited(io::stdin().lock())
    } else {
        File::open(path).and_then(limited)
    };
    let text = text.map_err(|error| about(path, &error))?;
    if text.len() as u64 > LARGEST {
        return Err(about(path, &"larger than 1 GiB"));
    }
    Ok(text)
}

fn limited(source: impl Read) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    source.take(LARGEST + 1).read_to_end(&mut text)?;
    Ok(text)
}

/// Writes to a file, or to standard output where there is none. A reader that went away wanted no
/// more of it, and is no failure.
pub(super) fn write(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path.filter(|path| !is_standard(path)) {
        Some(path) => {
            let mut file = File::create(path).map_err(|error| about(path, &error))?;
            file.write_all(text.as_bytes()).map_err(|error| unwritten(&named(path), &error))
        }
        None => print(text),
    }
}

/// Prints to standard output.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(unwritten("standard output", &error))
        }
        _ => Ok(()),
    }
}

/// Exit code of what is neither a result nor bad input.
pub(super) const BROKEN: u8 = 3;

fn unwritten(what: &str, error: &io::Error) -> Failure {
    Failure { code: BROKEN, lines: vec![format!("{what}: {error}")] }
}

fn about(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure::input(format!("{}: {error}", named(path)))
}

/// A path on one line.
fn named(path: &Path) -> String {
    if is_standard(path) {
        return "standard input".into();
    }
    let shown = path.display().to_string();
    shown.chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}
