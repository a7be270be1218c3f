//! [`Network`]: the values of a state by plain matrix products, without padding and without gradients.
//!
//! A row-major `[n, p]` is a column-major `p x n`, which is how nalgebra reads it: no matrix is ever copied
//! or transposed. The matrices of one state fit in a core's cache, so each state is computed on its own.

use std::cell::RefCell;

use nalgebra::{DMatrixView, DMatrixViewMut};
use rayon::prelude::*;
use voltour_solver::policy::{Batch, Encoding, FEATURES, IN_TOUR, QError, QFunction, REWARD};

use super::Weights;
use super::kernel::kernel;

/// A Q-network for acting; the same function as [`super::Differentiable`].
#[derive(Clone, Debug)]
pub struct Network {
    weights: Weights,
}

/// Room for one state, kept between states.
#[derive(Default)]
struct Room {
    kernels: Vec<Vec<f32>>,
    x: Vec<f32>,
    h: Vec<f32>,
    z: Vec<f32>,
    message: Vec<f32>,
    nodes: Vec<f32>,
    edges: Vec<f32>,
}

thread_local! {
    static ROOM: RefCell<Room> = RefCell::default();
}

impl Network {
    /// The network with these parameters.
    pub fn new(weights: Weights) -> Self {
        Self { weights }
    }

    /// Its parameters.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Its parameters, to be stepped.
    pub fn weights_mut(&mut self) -> &mut Weights {
        &mut self.weights
    }

    /// `q`, a value a row, of one state.
    pub fn values_of(&self, state: &Encoding) -> Vec<f32> {
        ROOM.with_borrow_mut(|room| {
            let mut edges = std::mem::take(&mut room.edges);
            edges.clear();
            for from in &state.places {
                let line = &state.edges.values[*from as usize * state.edges.size..];
                edges.extend(state.places.iter().map(|to| line[*to as usize]));
            }
            let values = self.compute(&state.nodes, &edges, room);
            room.edges = edges;
            values
        })
    }

    fn compute(&self, nodes: &[f32], edges: &[f32], room: &mut Room) -> Vec<f32> {
        let (n, shape) = (nodes.len() / FEATURES, self.weights.shape());
        let (p, count) = (shape.width, shape.kernels.len());
        if n == 0 {
            return Vec::new();
        }
        room.kernels.resize_with(count, Vec::new);
        for (scale, into) in shape.kernels.iter().zip(&mut room.kernels) {
            kernel(edges, n, *scale, into);
        }
        let part = |i: usize| self.weights.part(i);
        let (head, Room { x, h, z, message, kernels, .. }) = (3 + count, room);

        rows(x, part(1), n);
        product(part(0), nodes, x, [p, FEATURES, n]);
        relu(x, h);
        for _ in 0..shape.rounds {
            z.clone_from(x);
            product(part(2), h, z, [p, p, n]);
            for (k, weight) in kernels.iter().enumerate() {
                message.clear();
                message.resize(n * p, 0.0);
                product(part(3 + k), h, message, [p, p, n]);
                product(message, weight, z, [p, n, n]);
            }
            relu(z, h);
        }

        let mut state = part(head + 2).to_vec();
        product(part(head + 1), &means(nodes, h, p), &mut state, [p, 2 * p, 1]);
        rows(z, &state, n);
        product(part(head), h, z, [p, p, n]);
        let (output, offset) = (part(head + 3), part(head + 4)[0]);
        let value = |(g, f): (&[f32], &[f32])| {
            let after: f32 = g.iter().zip(output).map(|(g, o)| g.max(0.0) * o).sum();
            after + offset + f[REWARD]
        };
        z.chunks_exact(p).zip(nodes.chunks_exact(FEATURES)).map(value).collect()
    }
}

impl QFunction for Network {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        let mut q = vec![0.0; batch.states * batch.rows];
        let fill = |(state, q): (usize, &mut [f32])| {
            ROOM.with_borrow_mut(|room| {
                let (real, nodes, edges) = gather(batch, state, room);
                let values = self.compute(&nodes, &edges, room);
                real.into_iter().zip(values).for_each(|(row, value)| q[row] = value);
                (room.nodes, room.edges) = (nodes, edges);
            });
        };
        q.par_chunks_mut(batch.rows.max(1)).enumerate().for_each(fill);
        match q.iter().find(|v| !v.is_finite()) {
            Some(value) => Err(QError::NotFinite(value.to_string())),
            None => Ok(q),
        }
    }
}

/// The real rows of a state of a batch, and their features and travel times without padding.
fn gather(batch: &Batch, state: usize, room: &mut Room) -> (Vec<usize>, Vec<f32>, Vec<f32>) {
    let n = batch.rows;
    let (mut nodes, mut edges) = (std::mem::take(&mut room.nodes), std::mem::take(&mut room.edges));
    nodes.clear();
    edges.clear();
    let real: Vec<usize> = (0..n).filter(|row| batch.mask[state * n + row] > 0.0).collect();
    for row in &real {
        let at = state * n + row;
        nodes.extend_from_slice(&batch.nodes[at * FEATURES..(at + 1) * FEATURES]);
        let line = &batch.edges[at * n..(at + 1) * n];
        edges.extend(real.iter().map(|column| line[*column]));
    }
    (real, nodes, edges)
}

/// `[mean of h, mean of h over the tour]`, 2p numbers.
fn means(nodes: &[f32], h: &[f32], p: usize) -> Vec<f32> {
    let (mut means, mut stops) = (vec![0.0; 2 * p], 0.0);
    let n = (nodes.len() / FEATURES) as f32;
    for (f, h) in nodes.chunks_exact(FEATURES).zip(h.chunks_exact(p)) {
        let (all, tour) = means.split_at_mut(p);
        all.iter_mut().zip(h).for_each(|(m, h)| *m += h);
        if f[IN_TOUR] > 0.0 {
            tour.iter_mut().zip(h).for_each(|(m, h)| *m += f[IN_TOUR] * h);
        }
        stops += f[IN_TOUR];
    }
    means[..p].iter_mut().for_each(|m| *m /= n);
    means[p..].iter_mut().for_each(|m| *m /= f32::max(stops, 1.0));
    means
}

/// `out += a b` for column-major `a [m, k]`, `b [k, n]`, `out [m, n]`.
fn product(a: &[f32], b: &[f32], out: &mut [f32], [m, k, n]: [usize; 3]) {
    let (a, b) = (DMatrixView::from_slice(a, m, k), DMatrixView::from_slice(b, k, n));
    DMatrixViewMut::from_slice(out, m, n).gemm(1.0, &a, &b, 1.0);
}

/// Sets `into` to `n` copies of `row`.
fn rows(into: &mut Vec<f32>, row: &[f32], n: usize) {
    into.clear();
    (0..n).for_each(|_| into.extend_from_slice(row));
}

fn relu(from: &[f32], into: &mut Vec<f32>) {
    into.clear();
    into.extend(from.iter().map(|v| v.max(0.0)));
}
