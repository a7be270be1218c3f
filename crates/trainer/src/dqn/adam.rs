//! [`Adam`] (Kingma and Ba 2015) over one flat vector, and the clipping of gradients before it.
//!
//! Thirty lines here instead of burn's optimizer: the moments are plain numbers in the checkpoint, the
//! gradient is clipped as a whole instead of matrix by matrix, and every device steps alike.

const BETA_1: f64 = 0.9;
const BETA_2: f64 = 0.999;
const EPSILON: f64 = 1e-8;

/// The moments of the gradients so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Adam {
    /// Mean.
    pub first: Vec<f32>,
    /// Mean of the squares.
    pub second: Vec<f32>,
    /// Steps so far.
    pub steps: u64,
}

impl Adam {
    /// Before the first of the steps of so many parameters.
    pub fn new(parameters: usize) -> Self {
        Self { first: vec![0.0; parameters], second: vec![0.0; parameters], steps: 0 }
    }

    /// Steps the parameters against a gradient.
    pub fn step(&mut self, parameters: &mut [f32], gradient: &[f32], rate: f64) {
        self.steps += 1;
        let exponent = i32::try_from(self.steps).unwrap_or(i32::MAX);
        let correction = (1.0 - BETA_2.powi(exponent)).sqrt();
        let rate = (rate * correction / (1.0 - BETA_1.powi(exponent))) as f32;
        let (beta_1, beta_2, epsilon) =
            (BETA_1 as f32, BETA_2 as f32, (EPSILON * correction) as f32);
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((parameter, g), (first, second)) in parameters.iter_mut().zip(gradient).zip(moments) {
            *first += (1.0 - beta_1) * (g - *first);
            *second += (1.0 - beta_2) * (g * g - *second);
            *parameter -= rate * *first / (second.sqrt() + epsilon);
        }
    }
}

/// Scales a gradient down to the norm `limit` if it is longer; gives the norm that it had.
pub fn clip(gradient: &mut [f32], limit: f64) -> f64 {
    let norm = gradient.iter().map(|g| f64::from(*g).powi(2)).sum::<f64>().sqrt();
    if norm > limit {
        let factor = (limit / norm) as f32;
        gradient.iter_mut().for_each(|g| *g *= factor);
    }
    norm
}
