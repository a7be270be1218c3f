//! [`Differentiable`]: the network in burn, for the gradients of the loss.

use burn::tensor::activation::relu;
use burn::tensor::{Device, Tensor, TensorData};
use voltour_solver::policy::{Batch, FEATURES, IN_TOUR, REWARD};

use crate::error::{Error, Result};

use super::{Shape, Weights};

/// What the values of some actions should have been.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    /// `[B, N]`; anything finite where the weight is 0.
    pub values: Vec<f32>,
    /// `[B, N]`: how much an action counts; 0 for all of which nothing is known.
    pub weights: Vec<f32>,
    /// How much the errors within a state count beside the errors themselves: where several actions of a state
    /// are known, what matters is which is better.
    pub differences: f32,
}

/// The Q-network on a device that computes gradients; the same function as [`super::Network`].
#[derive(Clone, Debug)]
pub struct Differentiable {
    device: Device,
}

impl Differentiable {
    /// The network on a device.
    pub fn new(device: Device) -> Self {
        Self { device: device.autodiff() }
    }

    /// `q [B, N]`, 0 in rows of padding.
    ///
    /// # Errors
    /// The device does not give its numbers back.
    pub fn values(&self, weights: &Weights, batch: &Batch) -> Result<Vec<f32>> {
        let parameters = self.parameters(weights);
        numbers(forward(weights.shape(), &parameters, &Inputs::new(batch, &self.device)))
    }

    /// The weighted Huber loss of a batch, summed over its actions, and its gradient in the order of the weights.
    ///
    /// With errors `d = q - y` and weights `w` it is `sum w huber(d)` plus, where `differences` is not 0,
    /// that times `sum w huber(d - mean of d within the state)`. Huber's is quadratic within +-1.
    ///
    /// # Errors
    /// The device does not give its numbers back.
    pub fn gradient(
        &self,
        weights: &Weights,
        batch: &Batch,
        target: &Target,
    ) -> Result<(f32, Vec<f32>)> {
        let parameters: Vec<Tensor<2>> =
            self.parameters(weights).into_iter().map(Tensor::require_grad).collect();
        let q = forward(weights.shape(), &parameters, &Inputs::new(batch, &self.device));
        let size = [batch.states, batch.rows];
        let weight: Tensor<2> = tensor(&target.weights, size, &self.device);
        let error = q - tensor(&target.values, size, &self.device);
        let mut loss = (huber(error.clone()) * weight.clone()).sum();
        if target.differences > 0.0 {
            let total = weight.clone().sum_dim(1).clamp_min(1e-6);
            let mean = (error.clone() * weight.clone()).sum_dim(1) / total;
            loss = loss + (huber(error - mean) * weight).sum().mul_scalar(target.differences);
        }
        let mut gradients = loss.backward();
        let mut flat = Vec::with_capacity(weights.values().len());
        for (parameter, part) in parameters.iter().zip(weights.parts()) {
            match parameter.grad_remove(&mut gradients) {
                Some(gradient) => flat.extend(numbers(gradient)?),
                None => flat.resize(flat.len() + part.len(), 0.0),
            }
        }
        let loss = numbers(loss)?.first().copied().unwrap_or(f32::NAN);
        Ok((loss, flat))
    }

    fn parameters(&self, weights: &Weights) -> Vec<Tensor<2>> {
        let of = |(i, part): (usize, &super::Part)| {
            tensor(weights.part(i), [part.rows, part.columns], &self.device)
        };
        weights.parts().iter().enumerate().map(of).collect()
    }
}

/// A batch on the device.
struct Inputs {
    nodes: Tensor<3>,
    edges: Tensor<3>,
    mask: Tensor<2>,
}

impl Inputs {
    fn new(batch: &Batch, device: &Device) -> Self {
        let [b, n] = [batch.states, batch.rows];
        Self {
            nodes: tensor(&batch.nodes, [b, n, FEATURES], device),
            edges: tensor(&batch.edges, [b, n, n], device),
            mask: tensor(&batch.mask, [b, n], device),
        }
    }
}

/// `q [B, N]`.
fn forward(shape: &Shape, parameters: &[Tensor<2>], inputs: &Inputs) -> Tensor<2> {
    let [b, n, f] = inputs.nodes.dims();
    let p = shape.width;
    let part = |i: usize| parameters[i].clone();
    let columns: Tensor<3> = inputs.mask.clone().unsqueeze_dim(1);
    let kernel = |scale: &f32| {
        let kernel = inputs.edges.clone().mul_scalar(-1.0 / scale).exp() * columns.clone();
        let sum = kernel.clone().sum_dim(2).clamp_min(1e-30);
        kernel / sum
    };
    let kernels: Vec<Tensor<3>> = shape.kernels.iter().map(kernel).collect();
    let head = 3 + kernels.len();

    let x = inputs.nodes.clone().reshape([b * n, f]).matmul(part(0)) + part(1);
    let mut h = relu(x.clone());
    for _ in 0..shape.rounds {
        let mut z = x.clone() + h.clone().matmul(part(2));
        for (k, kernel) in kernels.iter().enumerate() {
            let message = h.clone().matmul(part(3 + k)).reshape([b, n, p]);
            z = z + kernel.clone().matmul(message).reshape([b * n, p]);
        }
        h = relu(z);
    }

    let pool = Tensor::cat(vec![mean_of(columns.clone()), mean_of(tour(inputs) * columns)], 1);
    let state =
        pool.matmul(h.clone().reshape([b, n, p])).reshape([b, 2 * p]).matmul(part(head + 1));
    let state: Tensor<3> = (state + part(head + 2)).unsqueeze_dim(1);
    let g = relu(h.matmul(part(head)).reshape([b, n, p]) + state);
    let after = g.reshape([b * n, p]).matmul(part(head + 3)) + part(head + 4);
    (after.reshape([b, n]) + column(inputs, REWARD).reshape([b, n])) * inputs.mask.clone()
}

/// `[B, 1, N]`: 1 for the stops of the tour so far.
fn tour(inputs: &Inputs) -> Tensor<3> {
    column(inputs, IN_TOUR).swap_dims(1, 2)
}

/// `[B, N, 1]`: one feature.
fn column(inputs: &Inputs, feature: usize) -> Tensor<3> {
    inputs.nodes.clone().narrow(2, feature, 1)
}

/// Rows of ones and zeros `[B, 1, N]` as the weights of a mean; zeros where none is one.
fn mean_of(members: Tensor<3>) -> Tensor<3> {
    let count = members.clone().sum_dim(2).clamp_min(1.0);
    members / count
}

/// Huber's function with threshold 1: `c (|d| - c/2)` with `c = min(|d|, 1)`.
fn huber(error: Tensor<2>) -> Tensor<2> {
    let size = error.abs();
    let near = size.clone().clamp_max(1.0);
    near.clone() * (size - near.mul_scalar(0.5))
}

fn tensor<const D: usize>(values: &[f32], size: [usize; D], device: &Device) -> Tensor<D> {
    Tensor::from_data(TensorData::new(values.to_vec(), size), device)
}

fn numbers<const D: usize>(tensor: Tensor<D>) -> Result<Vec<f32>> {
    tensor.into_data().try_to_vec::<f32>().map_err(|e| Error::Device(format!("{e:?}")))
}
