//! OR-Tools CP-SAT, run by a Python child process: one compiled instance after the other.

use std::error::Error;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::Deserialize;

use super::Compiled;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/proof/cpsat.py");
const REQUIREMENTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/proof/requirements.txt");
/// A folder under cargo's target folder.
const FOLDER: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/proof");

/// What CP-SAT made of its model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Verdict {
    /// Proven.
    Optimal,
    /// Proven that there is no tour.
    Infeasible,
    /// A tour, not proven within the limit.
    Feasible,
    /// Nothing within the limit.
    Unknown,
}

/// One answer of the script.
#[derive(Debug, Deserialize)]
pub struct Answer {
    /// What is known.
    pub status: Verdict,
    /// Wall time of CP-SAT's solve, without the building of the model.
    pub wall_s: f64,
    /// No tour is better, in the unit of the objective; the model's rounding only weakens it.
    pub bound: Option<f64>,
    /// The tour, as requests of the scenario; null if none was found.
    pub order: Option<Vec<usize>>,
}

/// The child process.
pub struct CpSat {
    child: Child,
    /// Takes one path of an instance a line; dropped first, which ends the child.
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl CpSat {
    /// Starts the script, after OR-Tools was installed where it is missing.
    pub fn start(limit_s: f64) -> Result<Self, Box<dyn Error>> {
        let python = environment()?;
        let mut child = Command::new(python)
            .args([SCRIPT, "--limit", &limit_s.to_string()])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let requests = child.stdin.take();
        let answers = BufReader::new(child.stdout.take().ok_or("the script has no output")?);
        Ok(Self { child, requests, answers })
    }

    /// Writes the instance into a file and has it solved.
    pub fn solve(&mut self, name: &str, compiled: &Compiled) -> Result<Answer, Box<dyn Error>> {
        let file = Path::new(FOLDER).join(format!("{name}.json"));
        fs::write(&file, serde_json::to_vec(compiled)?)?;
        let requests = self.requests.as_mut().ok_or("the script has no input")?;
        writeln!(requests, "{}", file.display())?;
        requests.flush()?;
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(format!("{name}: the script ended without an answer").into());
        }
        Ok(serde_json::from_str(&line)?)
    }
}

impl Drop for CpSat {
    /// The end of its input ends the script; waiting for it leaves no process behind.
    fn drop(&mut self) {
        drop(self.requests.take());
        let _ = self.child.wait();
    }
}

/// The Python of a virtual environment that has what the script needs.
fn environment() -> Result<PathBuf, Box<dyn Error>> {
    let home = Path::new(FOLDER).join("python");
    let python = home.join("bin/python");
    let stamp = home.join("requirements.txt");
    let wanted = fs::read(REQUIREMENTS)?;
    if fs::read(&stamp).is_ok_and(|installed| installed == wanted) && python.exists() {
        return Ok(python);
    }
    fs::create_dir_all(FOLDER)?;
    let fail = |error: Box<dyn Error>| {
        format!(
            "OR-Tools is not there to compare with: {error}. It is installed from {REQUIREMENTS} \
             into {}, which takes Python 3.10 or newer with venv and pip, and access to PyPI",
            home.display()
        )
    };
    eprintln!("installing OR-Tools into {}", home.display());
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&home)).map_err(fail)?;
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    run(install.args(["--requirement", REQUIREMENTS])).map_err(fail)?;
    // Written last: a broken installation is begun anew the next time.
    fs::write(&stamp, wanted)?;
    Ok(python)
}

fn run(command: &mut Command) -> Result<(), Box<dyn Error>> {
    // Its output would mix with the table.
    let status = command.stdout(Stdio::null()).status();
    let status = status.map_err(|error| format!("{:?}: {error}", command.get_program()))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}").into()) }
}
