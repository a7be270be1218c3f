//! [`Log`]: the runs of a bench, in a file that only grows.

use std::collections::HashSet;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::{BenchError, Entrant, Job, Run, Settings};

/// Runs, as `runs.csv` in a folder, with the settings that all have in common as `settings.json`.
#[derive(Debug)]
pub struct Log {
    path: PathBuf,
    file: File,
    runs: Vec<Run>,
    done: HashSet<(String, u64, String)>,
}

impl Log {
    /// Opens the log of a folder, which is made if it is not there. A line that an interruption cut off is
    /// dropped.
    ///
    /// # Errors
    /// A file cannot be read or written, or the folder holds runs under other settings.
    pub fn open(folder: &Path, settings: &Settings) -> Result<Self, BenchError> {
        fs::create_dir_all(folder).map_err(BenchError::file(folder))?;
        agree(&folder.join("settings.json"), settings)?;
        let path = folder.join("runs.csv");
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            text => text.map_err(BenchError::file(&path))?,
        };
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let runs: Result<Vec<Run>, csv::Error> =
            csv::Reader::from_reader(&text.as_bytes()[..whole]).into_deserialize().collect();
        let runs = runs.map_err(|error| BenchError::content(&path, error))?;
        let options = OpenOptions::new().create(true).append(true).open(&path);
        let file = options.map_err(BenchError::file(&path))?;
        file.set_len(whole as u64).map_err(BenchError::file(&path))?;
        let done = runs.iter().map(key).collect();
        Ok(Self { path, file, runs, done })
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn add(&mut self, run: Run) -> Result<(), BenchError> {
        let is_empty = self.file.metadata().map_err(BenchError::file(&self.path))?.len() == 0;
        let mut line = csv::WriterBuilder::new().has_headers(is_empty).from_writer(Vec::new());
        line.serialize(&run).map_err(|error| BenchError::content(&self.path, error))?;
        let line = line.into_inner().map_err(|error| BenchError::content(&self.path, error))?;
        self.file.write_all(&line).map_err(BenchError::file(&self.path))?;
        self.done.insert(key(&run));
        self.runs.push(run);
        Ok(())
    }

    /// All runs so far.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Who has not solved the scenario of a job yet.
    pub fn missing(&self, job: &Job) -> Vec<Entrant> {
        let group = job.group();
        let open = |e: &&Entrant| !self.done.contains(&(group.clone(), job.index, e.to_string()));
        job.entrants.iter().filter(open).copied().collect()
    }
}

fn key(run: &Run) -> (String, u64, String) {
    (run.group.clone(), run.index, run.algorithm.clone())
}

/// Writes the settings, or compares them with those that are there.
fn agree(path: &Path, settings: &Settings) -> Result<(), BenchError> {
    let text = match fs::read_to_string(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let text = serde_json::to_string_pretty(settings)
                .map_err(|error| BenchError::content(path, error))?;
            return fs::write(path, text + "\n").map_err(BenchError::file(path));
        }
        text => text.map_err(BenchError::file(path))?,
    };
    let there: Settings =
        serde_json::from_str(&text).map_err(|error| BenchError::content(path, error))?;
    match settings.difference(&there) {
        None => Ok(()),
        Some((name, here, there)) => Err(BenchError::content(
            path,
            format!(
                "{name} is {there} for the runs in this folder, not {here}: name another folder by --out"
            ),
        )),
    }
}
