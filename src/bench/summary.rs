//! [`Summary`]: an algorithm over the scenarios of a cell.

use std::collections::BTreeMap;

use voltour_solver::gap::to_best;
use voltour_solver::plan::Status;
use voltour_solver::tolerance::tolerance;

use super::{BenchError, Ended, Run};

/// The best tour that is known of a scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Its objective; `None` where no algorithm found a feasible one.
    pub objective: Option<f64>,
    /// Whether that is proven to be the best, or that there is none.
    pub proven: bool,
}

/// One algorithm in one cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Name of the entrant.
    pub algorithm: String,
    /// Scenarios that have a feasible tour.
    pub feasible: usize,
    /// Of these, those it solved.
    pub solved: usize,
    /// Those it was stopped on, by time or memory, without a tour.
    pub unfinished: usize,
    /// Those that the time ended with a tour: what was found depends on the machine.
    pub cut_short: usize,
    /// Mean objective of the scenarios solved, in the units of the plan document.
    pub mean_objective: Option<f64>,
    /// Mean gap of the scenarios solved to the best known, as a share.
    pub mean_gap: Option<f64>,
    /// Largest of these.
    pub largest_gap: Option<f64>,
    /// Median processor time, in seconds.
    pub median_s: f64,
    /// Largest processor time, in seconds.
    pub largest_s: f64,
}

/// The best known of each scenario of a cell.
///
/// # Errors
/// A tour is better than one that is proven the best, or found where none is proven to be.
pub fn references(
    runs: &[Run],
    group: &str,
    is_cost: bool,
) -> Result<BTreeMap<u64, Reference>, BenchError> {
    let mut known: BTreeMap<u64, Reference> = BTreeMap::new();
    let of_group = || runs.iter().filter(|run| run.group == group);
    // The best of all: a tour proven the best is as good as any that is found.
    for run in of_group() {
        let nothing = Reference { objective: None, proven: false };
        let best = known.entry(run.index).or_insert(nothing);
        best.proven |= matches!(run.status, Status::Optimal | Status::Infeasible);
        let better = |a: f64, b: f64| if is_cost { a.min(b) } else { a.max(b) };
        let objectives = [best.objective, run.found()];
        best.objective = objectives.into_iter().flatten().reduce(better);
    }
    for run in of_group() {
        let Some(best) = known.get(&run.index).and_then(|reference| reference.objective) else {
            continue;
        };
        let worse = if is_cost { run.objective - best } else { best - run.objective };
        let broken = match run.status {
            Status::Optimal => worse > tolerance(best),
            Status::Infeasible => true,
            Status::Feasible | Status::BestEffort => false,
        };
        if broken {
            return Err(BenchError::Defect {
                scenario: format!("{group}, scenario {}", run.index),
                algorithm: run.algorithm.clone(),
                problem: format!(
                    "its proof is refuted: {:?} {}, but {best} was found",
                    run.status, run.objective
                ),
            });
        }
    }
    Ok(known)
}

/// Each of the algorithms on the scenarios of a cell, as far as they were run.
pub fn summaries(
    runs: &[Run],
    group: &str,
    known: &BTreeMap<u64, Reference>,
    algorithms: &[String],
) -> Vec<Summary> {
    let of = |algorithm: &String| {
        let mine = runs.iter().filter(|run| run.group == group && run.algorithm == *algorithm);
        let pairs = mine.filter_map(|run| {
            let best = known.get(&run.index)?.objective?;
            Some((run, best))
        });
        summary(algorithm, &pairs.collect::<Vec<_>>())
    };
    algorithms.iter().map(of).collect()
}

fn summary(algorithm: &str, runs: &[(&Run, f64)]) -> Summary {
    let count = |holds: fn(&Run) -> bool| runs.iter().filter(|(run, _)| holds(run)).count();
    let found: Vec<f64> = runs.iter().filter_map(|(run, _)| run.found()).collect();
    let gap = |(run, best): &(&Run, f64)| run.found().map(|objective| to_best(objective, *best));
    let gaps: Vec<f64> = runs.iter().filter_map(gap).collect();
    let mut seconds: Vec<f64> = runs.iter().map(|(run, _)| run.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    Summary {
        algorithm: algorithm.to_owned(),
        feasible: runs.len(),
        solved: found.len(),
        unfinished: count(|run| run.ended != Ended::Itself && !run.solved()),
        cut_short: count(|run| run.ended == Ended::Time && run.solved()),
        mean_objective: mean(&found),
        mean_gap: mean(&gaps),
        largest_gap: gaps.iter().copied().reduce(f64::max),
        median_s: seconds.get(seconds.len() / 2).copied().unwrap_or(0.0),
        largest_s: seconds.last().copied().unwrap_or(0.0),
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
