//! The Q-network: structure2vec over the candidates (paper, section 5.2) with messages weighted by a kernel
//! of the travel time.
//!
//! For a state with N candidates, features `f [N, F]` and travel times `e [N, N]`:
//!
//! ```text
//! x  = W f + b                                                  [N, p]
//! h  = relu(x)                                                  [N, p]
//! h  = relu(x + W0 h + sum_k K_k W_k h)      T times            [N, p]
//! g  = relu(A h + B [mean of h, mean of h over the tour] + c)   [N, p]
//! q  = o . g + d + reward                                       [N]
//! ```
//!
//! `K_k = exp(-e / s_k)` with its rows normalised to 1. Three things differ from structure2vec as
//! published (Dai, Dai and Song 2016; Khalil et al. 2017):
//!
//! 1. Their neighbour sums lose the pairwise geometry on a complete graph and grow with N; the kernel
//!    keeps the first and its normalisation bounds the second.
//! 2. The immediate reward is known exactly, so it is added and the network learns what comes after it.
//! 3. A kernel's diagonal stays: what a candidate hears from afar then fades with the distance, and no
//!    row sum is ever zero.
//!
//! The arithmetic exists twice: [`Differentiable`] is burn's and gives gradients, [`Network`] is plain
//! matrix products for acting, and each is the other's test.

mod differentiable;
mod forward;
mod kernel;
mod shape;
mod weights;

pub use differentiable::{Differentiable, Target};
pub use forward::Network;
pub use shape::{Part, Shape};
pub use weights::Weights;
