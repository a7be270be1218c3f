//! Training of voltour's policies: deep Q-learning on the solver's episodes, written out as ONNX models.
//!
//! The [`network`] is structure2vec over the candidates of a scenario; [`dqn`] is the paper's Algorithm 1;
//! [`onnx`] writes and reads models as the service runs them. The network is differentiated by burn on a
//! CPU or, with the feature `cuda`, on a GPU; nothing outside this crate knows burn.

pub mod checkpoint;
pub mod dqn;
pub mod error;
pub mod evaluate;
pub mod file;
pub mod network;
pub mod onnx;
pub mod report;
pub mod scenarios;
pub mod stopwatch;

pub use error::{Error, Result};
