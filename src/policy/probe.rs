//! States that every model is tried on before it is used: of no scenario, always the same.

use voltour_solver::policy::{Batch, FEATURES};

/// One state, several with padding, and one that fills its rows.
pub(super) fn probes() -> [Batch; 3] {
    [states(1, 5, 5), states(3, 11, 7), states(2, 24, 24)]
}

/// So many states of so many rows, of which the first are candidates.
fn states(states: usize, rows: usize, candidates: usize) -> Batch {
    let is_real = |row: usize| f32::from(u8::from(row < candidates));
    let node = |i: usize| spread(i) * is_real(i / FEATURES % rows);
    let edge = |i: usize| {
        let (from, to) = (i / rows % rows, i % rows);
        // As long there as back, and between different candidates only.
        let length = 2.0 * spread(from.max(to) * rows + from.min(to) + 1);
        length * is_real(from) * is_real(to) * f32::from(u8::from(from != to))
    };
    Batch {
        states,
        rows,
        nodes: (0..states * rows * FEATURES).map(node).collect(),
        edges: (0..states * rows * rows).map(edge).collect(),
        mask: (0..states * rows).map(|i| is_real(i % rows)).collect(),
    }
}

/// Numbers from 0 to 1 that fill it evenly: the multiples of the golden ratio.
fn spread(i: usize) -> f32 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (i as f64 * GOLDEN).fract() as f32
}
