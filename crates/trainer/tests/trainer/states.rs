//! Random states.

use rand_pcg::Pcg64Mcg;
use voltour_solver::policy::{Batch, FEATURES, IN_TOUR};
use voltour_trainer::dqn::{index, stream, unit};
use voltour_trainer::network::{Shape, Weights};

pub fn weights(seed: u64) -> Weights {
    Weights::random(Shape::default(), seed)
}

/// States of random sizes, the first of the largest, the last of one row.
pub fn batch(states: usize, rows: usize, seed: u64) -> Batch {
    let mut rng = stream(seed, 100, 0);
    let mut batch = Batch {
        states,
        rows,
        nodes: vec![0.0; states * rows * FEATURES],
        edges: vec![0.0; states * rows * rows],
        mask: vec![0.0; states * rows],
    };
    for b in 0..states {
        let real = match b {
            0 => rows,
            _ if b + 1 == states => 1,
            _ => 1 + index(&mut rng, rows),
        };
        fill(&mut batch, b, real, &mut rng);
    }
    batch
}

fn fill(batch: &mut Batch, b: usize, real: usize, rng: &mut Pcg64Mcg) {
    let n = batch.rows;
    let points: Vec<[f64; 2]> = (0..real).map(|_| [2.0 * unit(rng), 2.0 * unit(rng)]).collect();
    for (i, p) in points.iter().enumerate() {
        let row = b * n + i;
        batch.mask[row] = 1.0;
        let features = &mut batch.nodes[row * FEATURES..(row + 1) * FEATURES];
        features.iter_mut().for_each(|f| *f = (2.0 * unit(rng) - 1.0) as f32);
        features[IN_TOUR] = f32::from(u8::from(unit(rng) < 0.3));
        for (j, q) in points.iter().enumerate() {
            batch.edges[row * n + j] = (p[0] - q[0]).hypot(p[1] - q[1]) as f32;
        }
    }
}

/// The same states with `more` rows of padding each.
pub fn padded(batch: &Batch, more: usize) -> Batch {
    let (n, m) = (batch.rows, batch.rows + more);
    let mut wide = Batch {
        states: batch.states,
        rows: m,
        nodes: vec![0.0; batch.states * m * FEATURES],
        edges: vec![0.0; batch.states * m * m],
        mask: vec![0.0; batch.states * m],
    };
    for b in 0..batch.states {
        for i in 0..n {
            let (from, to) = (b * n + i, b * m + i);
            wide.mask[to] = batch.mask[from];
            wide.nodes[to * FEATURES..(to + 1) * FEATURES]
                .copy_from_slice(&batch.nodes[from * FEATURES..(from + 1) * FEATURES]);
            wide.edges[to * m..to * m + n].copy_from_slice(&batch.edges[from * n..(from + 1) * n]);
        }
    }
    wide
}

/// The same states with the rows in another order: row `i` is the old row `order[i]`.
pub fn reordered(batch: &Batch, order: &[usize]) -> Batch {
    let n = batch.rows;
    let mut other = batch.clone();
    for b in 0..batch.states {
        for (i, &from) in order.iter().enumerate() {
            let (row, old) = (b * n + i, b * n + from);
            other.mask[row] = batch.mask[old];
            other.nodes[row * FEATURES..(row + 1) * FEATURES]
                .copy_from_slice(&batch.nodes[old * FEATURES..(old + 1) * FEATURES]);
            for (j, &to) in order.iter().enumerate() {
                other.edges[row * n + j] = batch.edges[old * n + to];
            }
        }
    }
    other
}

/// Whether two vectors are equal to 1e-5 of the larger of their largest entry and 1.
#[track_caller]
pub fn assert_close(a: &[f32], b: &[f32]) {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().chain(b).fold(1.0f32, |m, v| m.max(v.abs()));
    for (i, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= 1e-5 * scale, "{i}: {x} is not {y}");
    }
}
