//! [`Weights`]: the parameters of a network as plain numbers, which is how they are stored and stepped.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::{Part, Shape};

/// The parameters of a network: one flat vector, cut by [`Shape::parts`].
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    shape: Shape,
    parts: Vec<Part>,
    values: Vec<f32>,
}

impl Weights {
    /// Parameters to begin with: uniform in +-1/sqrt(rows), biases like the matrix before them.
    pub fn random(shape: Shape, seed: u64) -> Self {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let parts = shape.parts();
        let mut values = Vec::with_capacity(shape.parameters());
        for (i, part) in parts.iter().enumerate() {
            let bias = part.rows == 1 && i > 0;
            let fan_in = if bias { parts[i - 1].rows } else { part.rows };
            let bound = 1.0 / (fan_in.max(1) as f32).sqrt();
            values.extend((0..part.len()).map(|_| bound * (2.0 * unit(&mut rng) - 1.0)));
        }
        Self { shape, parts, values }
    }

    /// Parameters from a flat vector in the order of [`Shape::parts`]; `None` if their number is another.
    pub fn from_values(shape: Shape, values: Vec<f32>) -> Option<Self> {
        let parts = shape.parts();
        (values.len() == shape.parameters()).then_some(Self { shape, parts, values })
    }

    /// The size of the network.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The matrices, in order.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The numbers of one matrix, row by row.
    pub fn part(&self, index: usize) -> &[f32] {
        let part = &self.parts[index];
        &self.values[part.start..part.start + part.len()]
    }

    /// All numbers.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// All numbers, to be stepped.
    pub fn values_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.values.iter().all(|v| v.is_finite())
    }
}

/// Uniform in [0, 1), from 24 raw bits: the same for good, whatever the library's distributions become.
fn unit(rng: &mut Pcg64Mcg) -> f32 {
    (rng.next_u32() >> 8) as f32 / (1u32 << 24) as f32
}
