//! Rounding the sizes of a batch up, so that few sizes have to be optimised for: rows of padding, and whole
//! states of them.

use voltour_solver::policy::{Batch, FEATURES};

/// Most states that are run at once.
const MOST_STATES: usize = 32;

/// Most values in the edges of one run: 32 MiB.
const MOST_EDGES: usize = 1 << 23;

/// Most candidates of a state; one of this size alone has edges of 64 MiB.
pub(super) const MOST_ROWS: usize = 4_096;

/// Rows of the padded batch of states with so many: a multiple of 8, and of an eighth of the power of two above.
pub(super) fn padded_rows(rows: usize) -> usize {
    rows.next_multiple_of((rows.next_power_of_two() / 8).max(8))
}

/// How many states with so many rows are run at once: a power of two.
pub(super) fn states_at_once(rows: usize) -> usize {
    let rows = padded_rows(rows).max(1);
    let fit = (MOST_EDGES / (rows * rows)).clamp(1, MOST_STATES);
    // The power of two at or below it.
    1 << fit.ilog2()
}

/// States of the padded batch of so many: 1, 8, 16 or 32, no more than are run at once. Smaller steps would cost
/// more, for a graph takes longer to be optimised than a few states to be run.
fn padded_states(states: usize, at_once: usize) -> usize {
    if states <= 1 { states } else { states.next_power_of_two().max(8).min(at_once) }
}

/// So many states of a batch, at most as many as are run at once; padded.
pub(super) fn padded(batch: &Batch, from: usize, states: usize) -> Batch {
    let (n, rows) = (batch.rows, padded_rows(batch.rows));
    let all = padded_states(states, states_at_once(batch.rows));
    let mut padded = Batch {
        states: all,
        rows,
        nodes: vec![0.0; all * rows * FEATURES],
        edges: vec![0.0; all * rows * rows],
        mask: vec![0.0; all * rows],
    };
    for state in 0..states {
        let (to, from) = (state * rows, (from + state) * n);
        copy(&mut padded.nodes, to * FEATURES, &batch.nodes, from * FEATURES, n * FEATURES);
        copy(&mut padded.mask, to, &batch.mask, from, n);
        for row in 0..n {
            copy(&mut padded.edges, (to + row) * rows, &batch.edges, (from + row) * n, n);
        }
    }
    padded
}

fn copy(to: &mut [f32], at: usize, from: &[f32], begin: usize, count: usize) {
    to[at..at + count].copy_from_slice(&from[begin..begin + count]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_sizes_and_bounded_ones() {
        assert_eq!([1, 7, 8, 9, 60, 66, 80, 300].map(padded_rows), [8, 8, 8, 16, 64, 80, 80, 320]);
        assert_eq!([1, 80, 512, 600, 1_000, 4_096].map(states_at_once), [32, 32, 32, 16, 8, 1]);
        let padded = |states| padded_states(states, 32);
        assert_eq!([1, 2, 7, 9, 16, 17].map(padded), [1, 8, 8, 16, 16, 32]);
        assert_eq!([1, 2, 3].map(|states| padded_states(states, 4)), [1, 4, 4]);
    }

    #[test]
    fn what_was_there_keeps_its_place_and_the_rest_is_zero() {
        let batch = Batch {
            states: 3,
            rows: 2,
            nodes: (0..3 * 2 * FEATURES).map(|i| 1.0 + i as f32).collect(),
            edges: (0..12).map(|i| 1.0 + i as f32).collect(),
            mask: vec![1.0; 6],
        };
        let padded = padded(&batch, 1, 2);
        assert_eq!((padded.states, padded.rows), (8, 8));
        assert_eq!(padded.nodes.iter().filter(|value| **value != 0.0).count(), 4 * FEATURES);
        assert_eq!(padded.nodes[8 * FEATURES], batch.nodes[4 * FEATURES]);
        // State 2, from row 1 to row 0.
        assert_eq!(padded.edges[64 + 8], batch.edges[8 + 2]);
        assert_eq!(padded.edges.iter().sum::<f32>(), batch.edges[4..].iter().sum::<f32>());
        assert_eq!(padded.mask.iter().sum::<f32>(), 4.0);
    }
}
