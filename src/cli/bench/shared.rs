//! What both benches take, and how they run.

use std::num::NonZero;
use std::path::Path;
use std::thread::available_parallelism;
use std::time::Duration;

use super::bar::Bar;
use crate::bench::{BenchError, Job, Log, Settings, Trained, work};
use crate::cli::documents::BROKEN;
use crate::cli::{Failure, solve};

/// Limits, seed, threads.
#[derive(Debug, clap::Args)]
pub struct Shared {
    /// Processor time of each algorithm on each scenario at most
    #[arg(long, value_name = "TIME", default_value = "10s", value_parser = solve::time)]
    pub time_limit: Duration,
    /// Iterations of baseline, so that its tours do not depend on the machine
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub iterations: u64,
    /// Memory that acs, dp and app may use, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..))]
    pub memory_limit: u32,
    /// Seed of the scenarios and of every random choice
    #[arg(long, value_name = "S", default_value_t = 0, value_parser = clap::value_parser!(u64).range(..=1_000_000))]
    pub seed: u64,
    /// Scenarios solved at the same time, each on one thread; times are processor time of that thread [default: one
    /// a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
}

impl Shared {
    /// Does what is left of the jobs; the log of the folder has them all then.
    pub(super) fn work(
        &self,
        folder: &Path,
        jobs: &[Job],
        trained: &Trained,
    ) -> Result<Log, Failure> {
        let settings = Settings {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: self.seed,
            time_limit_s: self.time_limit.as_secs_f64(),
            iterations: self.iterations,
            memory_mib: self.memory_limit,
            policies: trained.digests(),
        };
        let mut log = Log::open(folder, &settings).map_err(failure)?;
        let open: usize = jobs.iter().map(|job| log.missing(job).len()).sum();
        let bar = Bar::new(open as u64);
        let cores = || available_parallelism().map_or(1, NonZero::get);
        let threads = self.jobs.map_or_else(cores, usize::from);
        let worked = work(jobs, &mut log, &settings, trained, threads, |run| bar.step(run));
        bar.end();
        worked.map(|()| log).map_err(failure)
    }
}

/// The policies of this binary.
pub(super) fn trained() -> Result<Trained, Failure> {
    Trained::embedded().map_err(|error| Failure::other(format!("defect: {error}")))
}

/// How a bench that cannot go on ends.
pub(super) fn failure(error: BenchError) -> Failure {
    let code = match &error {
        error if error.is_input() => return Failure::input(error.to_string()),
        BenchError::Defect { .. } => BROKEN,
        _ => 1,
    };
    Failure { code, lines: vec![error.to_string()] }
}
