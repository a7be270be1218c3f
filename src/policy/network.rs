//! [`Network`]: an ONNX graph as a Q-function.

use voltour_solver::policy::{Batch, FEATURES, QError, QFunction};

use super::graph::{Graph, RunError};
use super::pad::{MOST_ROWS, padded, states_at_once};

/// A graph as a Q-function: sizes rounded up, large batches in parts, no value that is not finite.
#[derive(Debug)]
pub(super) struct Network(pub Graph);

impl QFunction for Network {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        well_formed(batch)?;
        let mut values = Vec::with_capacity(batch.states * batch.rows);
        let at_once = states_at_once(batch.rows);
        for from in (0..batch.states).step_by(at_once) {
            let states = at_once.min(batch.states - from);
            let padded = padded(batch, from, states);
            let q = self.0.run(&padded).map_err(|error| failed(error, &padded))?;
            for state in 0..states {
                values.extend_from_slice(&q[state * padded.rows..][..batch.rows]);
            }
        }
        finite(batch, values)
    }
}

/// No value of a candidate may be NaN or infinite; rows of padding mean nothing and become 0.
fn finite(batch: &Batch, mut values: Vec<f32>) -> Result<Vec<f32>, QError> {
    for (i, (value, mask)) in values.iter_mut().zip(&batch.mask).enumerate() {
        if *mask == 0.0 {
            *value = 0.0;
        } else if !value.is_finite() {
            let (state, row) = (i / batch.rows, i % batch.rows);
            return Err(QError::NotFinite(format!("{value} (state {state}, candidate {row})")));
        }
    }
    Ok(values)
}

fn failed(error: RunError, batch: &Batch) -> QError {
    match error {
        RunError::Failed(reason) => QError::Failed(reason),
        RunError::Shape(shape) => {
            QError::WrongSize { expected: batch.states * batch.rows, found: shape.iter().product() }
        }
    }
}

/// A batch that is not what it says would be a defect of the solver.
fn well_formed(batch: &Batch) -> Result<(), QError> {
    let (b, n) = (batch.states, batch.rows);
    if n > MOST_ROWS {
        return Err(QError::Failed(format!("{n} candidates; at most {MOST_ROWS} are possible")));
    }
    let found = [batch.nodes.len(), batch.edges.len(), batch.mask.len()];
    if found != [b * n * FEATURES, b * n * n, b * n] {
        return Err(QError::Failed(format!(
            "tensors of {found:?} values for {b} states of {n} rows"
        )));
    }
    Ok(())
}
