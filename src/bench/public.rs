//! [`Public`]: a folder of public instances with the best values known of them.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use voltour_solver::gap::to_best;
use voltour_solver::scenario::Objective;
use voltour_solver::tolerance::tolerance;

use super::sheet::time;
use super::{BenchError, Entrant, Job, Run, Source};

/// Scenario documents, each with the best objective known.
#[derive(Clone, Debug)]
pub struct Public {
    folder: PathBuf,
    best: Vec<Best>,
}

/// A line of `best.csv`.
#[derive(Clone, Debug, Deserialize)]
struct Best {
    file: String,
    objective: Objective,
    best_known: f64,
    proven: String,
    source: String,
}

/// How an algorithm did on all of them.
#[derive(Default)]
struct Total {
    runs: usize,
    solved: usize,
    as_good: usize,
    gaps: Vec<f64>,
    seconds: Vec<f64>,
}

impl Public {
    /// What `best.csv` of a folder lists.
    ///
    /// # Errors
    /// It cannot be read, or a line is none.
    pub fn read(folder: &Path) -> Result<Self, BenchError> {
        let path = folder.join("best.csv");
        let text = std::fs::read(&path).map_err(BenchError::file(&path))?;
        let lines = csv::Reader::from_reader(text.as_slice()).into_deserialize().collect();
        let best: Result<Vec<Best>, csv::Error> = lines;
        let best = best.map_err(|error| BenchError::content(&path, error))?;
        let plain = |best: &&Best| Path::new(&best.file).components().count() != 1;
        if let Some(best) = best.iter().find(plain) {
            let problem = format!("file {:?}: must be the name of a file beside it", best.file);
            return Err(BenchError::content(&path, problem));
        }
        Ok(Self { folder: folder.to_owned(), best })
    }

    /// A job for each.
    pub fn jobs(&self, entrants: &[Entrant]) -> Vec<Job> {
        let job = |best: &Best| Job {
            source: Source::File(self.folder.join(&best.file)),
            index: 0,
            entrants: entrants.to_vec(),
        };
        self.best.iter().map(job).collect()
    }

    /// Instance by instance, and all together, as Markdown. Where a tour is better than what the folder says is
    /// proven, the gap is marked by `!`.
    pub fn markdown(&self, runs: &[Run], entrants: &[Entrant]) -> String {
        let names: Vec<String> = entrants.iter().map(ToString::to_string).collect();
        let mut totals: BTreeMap<&str, Total> = BTreeMap::new();
        let mut text = String::from("| instance | best known | ");
        text += &names.join(" | ");
        text += " |\n| --- | --- |";
        text += &" --- |".repeat(names.len());
        text.push('\n');
        for best in &self.best {
            let proven = if best.proven == "yes" { "" } else { " (not proven)" };
            let _ =
                write!(text, "| {} ({}) | {}{proven} |", best.file, best.source, best.best_known);
            for name in &names {
                let mine = |run: &&Run| run.group == best.file && run.algorithm == *name;
                let run = runs.iter().find(mine);
                if let Some(run) = run {
                    totals.entry(name).or_default().add(run, best);
                }
                let _ = write!(text, " {} |", run.map_or(String::new(), |run| best.cell(run)));
            }
            text.push('\n');
        }
        text += "\n| algorithm | solved | as good as the best known | mean gap | largest | median time | longest |\n| --- | --- | --- | --- | --- | --- | --- |\n";
        for name in &names {
            let line = totals.get(name.as_str()).map_or(String::new(), |total| total.line(name));
            text += &line;
        }
        text
    }
}

impl Best {
    /// A run beside it.
    fn cell(&self, run: &Run) -> String {
        let Some(objective) = run.found() else { return format!("none, {}", time(run.seconds)) };
        let ahead = if self.objective == Objective::MinDistance {
            self.best_known - objective
        } else {
            objective - self.best_known
        };
        let better = self.proven == "yes" && ahead > tolerance(self.best_known);
        let mark = if better { "!" } else { "" };
        let gap = 100.0 * to_best(objective, self.best_known);
        format!("{objective:.2}, {gap:.2} %{mark}, {}", time(run.seconds))
    }
}

impl Total {
    fn add(&mut self, run: &Run, best: &Best) {
        self.runs += 1;
        self.seconds.push(run.seconds);
        if let Some(objective) = run.found() {
            let gap = to_best(objective, best.best_known);
            self.solved += 1;
            self.as_good += usize::from(gap == 0.0);
            self.gaps.push(gap);
        }
    }

    fn line(&self, name: &str) -> String {
        let mut seconds = self.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        let at = |i: usize| seconds.get(i).map_or(String::new(), |&seconds| time(seconds));
        let mean = self.gaps.iter().sum::<f64>() / self.gaps.len().max(1) as f64;
        let largest = self.gaps.iter().copied().fold(0.0, f64::max);
        format!(
            "| {name} | {} of {} | {} | {:.2} % | {:.2} % | {} | {} |\n",
            self.solved,
            self.runs,
            self.as_good,
            100.0 * mean,
            100.0 * largest,
            at(seconds.len() / 2),
            at(seconds.len().wrapping_sub(1)),
        )
    }
}
