//! [`Batch`]: states of episodes as the tensors of the ONNX contract.

/// States as the tensors that a Q-function takes; float32, row by row, all of one size.
///
/// | tensor | shape | holds |
/// | --- | --- | --- |
/// | `nodes` | `[B, N, F]` | the features of each candidate, see [`super::FEATURES`]; zero rows as padding |
/// | `edges` | `[B, N, N]` | travel time between two candidates over the scale of the instance |
/// | `mask` | `[B, N]` | 1 where the row is a candidate, 0 where it is padding |
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// Number of states, B.
    pub states: usize,
    /// Rows a state, N.
    pub rows: usize,
    /// `[B, N, F]` with F = [`super::FEATURES`].
    pub nodes: Vec<f32>,
    /// `[B, N, N]`.
    pub edges: Vec<f32>,
    /// `[B, N]`.
    pub mask: Vec<f32>,
}
