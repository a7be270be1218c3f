//! What these tests, and those of the planner, start from.

use std::sync::Arc;

use voltour_solver::policy::{Batch, FEATURE_VERSION, FEATURES, Problem, QError, QFunction};

use super::onnx::Onnx;
use crate::policy::{About, Fault, Policies, Policy, load};

/// A policy of any function.
pub(crate) fn policy(problem: Problem, function: Arc<dyn QFunction>) -> Policy {
    let about = About {
        name: problem.name().to_owned(),
        source: "a test".to_owned(),
        digest: "0".repeat(64),
        problem,
        feature_version: FEATURE_VERSION,
        training: String::new(),
        evaluation: String::new(),
    };
    Policy { about: Arc::new(about), function }
}

/// Policies to which everything is worth nothing.
pub(crate) fn zeros() -> Policies {
    struct Zeros;
    impl QFunction for Zeros {
        fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
            Ok(vec![0.0; batch.mask.len()])
        }
    }
    Policies::new(|problem| Ok(policy(problem, Arc::new(Zeros))))
}

pub(super) fn loaded(bytes: &[u8]) -> Result<Policy, Fault> {
    load("folder/reward.onnx", bytes, Some(Problem::Reward)).map_err(|error| error.fault)
}

pub(super) fn good() -> Policy {
    loaded(&Onnx::of("reward").bytes()).unwrap()
}

/// So many states of so many rows, with other values than the probes.
pub(super) fn batch(states: usize, rows: usize) -> Batch {
    let value = |i: usize| (i as f32 * 0.37).sin().abs();
    Batch {
        states,
        rows,
        nodes: (0..states * rows * FEATURES).map(value).collect(),
        edges: (0..states * rows * rows).map(value).collect(),
        mask: vec![1.0; states * rows],
    }
}

/// The states of a batch from one on, and rows of padding after each.
pub(super) fn part(batch: &Batch, from: usize, states: usize, more: usize) -> Batch {
    let (n, rows) = (batch.rows, batch.rows + more);
    let mut part = Batch { states, rows, ..Batch::default() };
    for state in from..from + states {
        for row in 0..rows {
            let at = state * n + row;
            let real = row < n;
            part.mask.push(if real { batch.mask[at] } else { 0.0 });
            part.nodes.extend(
                (0..FEATURES).map(|f| if real { batch.nodes[at * FEATURES + f] } else { 0.0 }),
            );
            part.edges.extend(
                (0..rows).map(|to| if real && to < n { batch.edges[at * n + to] } else { 0.0 }),
            );
        }
    }
    part
}

pub(super) fn close(a: f32, b: f32) -> bool {
    (a - b).abs() <= 1e-5 * (1.0 + b.abs())
}
