//! [`work`]: jobs on several threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

use serde_json::Value;
use voltour_solver::policy::{Problem, QFunction};

use super::measure::Prepared;
use super::{BenchError, Entrant, Job, Log, Run, Settings};
use crate::policy::{ModelError, Policy, embedded};

/// Runs that may wait to be written.
const WAITING: usize = 64;

/// The policies that take part.
#[derive(Clone, Debug, Default)]
pub struct Trained(Vec<Policy>);

impl Trained {
    /// Those that are part of the binary.
    ///
    /// # Errors
    /// One is missing or does not pass a check.
    pub fn embedded() -> Result<Self, ModelError> {
        Problem::ALL.into_iter().map(embedded).collect::<Result<_, _>>().map(Self)
    }

    /// SHA-256 of each, by problem.
    pub fn digests(&self) -> BTreeMap<String, String> {
        let digest =
            |policy: &Policy| (policy.about.problem.to_string(), policy.about.digest.clone());
        self.0.iter().map(digest).collect()
    }

    /// Seconds that the training of a problem's policy took, if it says so.
    pub fn training_s(&self, problem: Problem) -> Option<f64> {
        let training: Value = serde_json::from_str(&self.of(problem)?.about.training).ok()?;
        training.get("seconds")?.as_f64()
    }

    fn of(&self, problem: Problem) -> Option<&Policy> {
        self.0.iter().find(|policy| policy.about.problem == problem)
    }
}

/// Does the jobs, in their order, as far as the log does not have them; each run is told and kept as soon as it
/// is done.
///
/// # Errors
/// The first; what is under way then is given up.
pub fn work(
    jobs: &[Job],
    log: &mut Log,
    settings: &Settings,
    trained: &Trained,
    threads: usize,
    mut tell: impl FnMut(&Run),
) -> Result<(), BenchError> {
    let jobs: Vec<(&Job, Vec<Entrant>)> = jobs.iter().map(|job| (job, log.missing(job))).collect();
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        let (sender, runs) = sync_channel(WAITING);
        for _ in 0..threads {
            let (sender, jobs, next) = (sender.clone(), &jobs, &next);
            scope.spawn(move || {
                while let Some((job, open)) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if let Err(error) = solve(job, open, settings, trained, &sender) {
                        // Where nobody listens any more, another error came first.
                        let _ = sender.send(Err(error));
                        return;
                    }
                }
            });
        }
        drop(sender);
        runs.into_iter().try_for_each(|run: Result<Run, BenchError>| {
            let run = run?;
            tell(&run);
            log.add(run)
        })
    })
}

/// One job; ends early where nobody takes its runs.
fn solve(
    job: &Job,
    open: &[Entrant],
    settings: &Settings,
    trained: &Trained,
    runs: &SyncSender<Result<Run, BenchError>>,
) -> Result<(), BenchError> {
    if open.is_empty() {
        return Ok(());
    }
    let (scenario, group) = (job.scenario()?, job.group());
    let prepared = Prepared::new(&group, job.index, &scenario);
    let policy = trained.of(Problem::of(scenario.objective)).map(|policy| &*policy.function);
    for entrant in open {
        let run = prepared.measure(entrant, settings, policy.map(|p| p as &dyn QFunction))?;
        if runs.send(Ok(run)).is_err() {
            break;
        }
    }
    Ok(())
}
