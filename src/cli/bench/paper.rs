//! `voltour bench paper`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::shared::{Shared, failure, trained};
use crate::bench::{
    BenchError, Job, Sheet, Source, Table, Trained, paper_jobs, plot, published, replaced, tables,
};
use crate::cli::{Failure, documents};

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Tables: mobile-network-size, mobile-time-step, reward-network-size, reward-capacity, network-size,
coverage-requirement, energy-threshold-32, energy-threshold-48.

Every run is kept in runs.csv as soon as it is done: interrupt the command whenever you like, and give it again
to go on. With more --scenarios it goes on from fewer. For each table it writes TABLE.csv and TABLE.svg, for all
of them tables.md.

Same seed, same tours, but for those that the time limit cut short, which the tables count.

Exit codes:
  0  the tables are written
  2  bad arguments, or a folder that holds runs under other settings
  3  an algorithm broke its promise: a plan that does not hold, or better than the proven optimum (a defect)

Examples:
  voltour bench paper --scenarios 30 --out bench
  voltour bench paper network-size coverage-requirement --time-limit 1m")]
pub struct Args {
    /// Which tables [default: all]
    #[arg(value_name = "TABLE", value_parser = table)]
    pub tables: Vec<String>,
    /// Scenarios of each cell
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub scenarios: u64,
    /// Limits, seed, threads.
    #[command(flatten)]
    pub shared: Shared,
    /// Folder of the runs, the tables and the plots
    #[arg(long, value_name = "DIR", default_value = "bench-paper")]
    pub out: PathBuf,
    /// Markdown document in which the tables between `<!-- bench TABLE -->` and `<!-- bench end -->` are renewed; its
    /// plots and CSV go to the folder of the same name without the extension
    #[arg(long, value_name = "FILE")]
    pub document: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let all = tables();
    let chosen =
        |table: &Table| args.tables.is_empty() || args.tables.iter().any(|name| name == table.name);
    let tables: Vec<Table> = all.into_iter().filter(chosen).collect();
    // Before hours of work, not after.
    let mut document = match args.document.as_deref() {
        Some(path) => Some((path, marked(path, &tables)?)),
        None => None,
    };
    let trained = trained()?;
    let jobs = paper_jobs(&tables, args.scenarios, args.shared.seed);
    let log = args.shared.work(&args.out, &jobs, &trained)?;
    // The log may hold more scenarios than are asked for now.
    let runs: Vec<_> =
        log.runs().iter().filter(|run| run.index < args.scenarios).cloned().collect();
    let figures = published();
    let mut text = String::new();
    for table in &tables {
        let sheet = Sheet::of(table, &runs, &figures).map_err(failure)?;
        let markdown = sheet.markdown(training(table, &jobs, &trained));
        save(&args.out, &sheet)?;
        if let Some((path, document)) = &mut document {
            save(&path.with_extension(""), &sheet)?;
            if let Some(renewed) = replaced(document, table.name, &markdown) {
                *document = renewed;
            }
        }
        text += &markdown;
        text.push('\n');
    }
    write(&args.out.join("tables.md"), text.as_bytes())?;
    if let Some((path, document)) = &document {
        write(path, document.as_bytes())?;
    }
    documents::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// The table as CSV and as a plot.
fn save(folder: &Path, sheet: &Sheet<'_>) -> Result<(), Failure> {
    let path = |kind: &str| folder.join(format!("{}.{kind}", sheet.table.name));
    let csv = sheet.csv().map_err(|error| Failure::other(error.to_string()))?;
    fs::create_dir_all(folder).map_err(BenchError::file(folder)).map_err(failure)?;
    write(&path("csv"), &csv)?;
    write(&path("svg"), plot(sheet).map_err(failure)?.as_bytes())
}

/// How long the table's policy was trained, and for how many scenarios of this run.
fn training(table: &Table, jobs: &[Job], trained: &Trained) -> Option<(f64, usize)> {
    let problem = table.settings.first()?.cell.problem();
    let of = |job: &&Job| match &job.source {
        Source::Cell { cell, .. } => cell.problem() == problem,
        Source::File(_) => false,
    };
    Some((trained.training_s(problem)?, jobs.iter().filter(of).count()))
}

fn table(name: &str) -> Result<String, String> {
    let tables = tables();
    if tables.iter().any(|table| table.name == name) {
        return Ok(name.to_owned());
    }
    let known: Vec<&str> = tables.iter().map(|table| table.name).collect();
    Err(format!("must be one of {}", known.join(", ")))
}

/// A document with a place for each of the tables.
fn marked(path: &Path, tables: &[Table]) -> Result<String, Failure> {
    let text = fs::read_to_string(path).map_err(BenchError::file(path)).map_err(failure)?;
    match tables.iter().find(|table| replaced(&text, table.name, "").is_none()) {
        None => Ok(text),
        Some(table) => Err(Failure::input(format!(
            "--document {}: must have <!-- bench {} --> and <!-- bench end -->",
            path.display(),
            table.name
        ))),
    }
}

fn write(path: &Path, content: &[u8]) -> Result<(), Failure> {
    fs::write(path, content).map_err(BenchError::file(path)).map_err(failure)
}
