//! Models as the service runs them: ONNX, opset 17, with everything that a reader must know in the metadata.
//!
//! | tensor | shape |
//! | --- | --- |
//! | `nodes` | `[B, N, F]` |
//! | `edges` | `[B, N, N]` |
//! | `mask` | `[B, N]` |
//! | `q`, the output | `[B, N]`, 0 in rows of padding |
//!
//! B and N are symbols. The parameters are initializers under the names of
//! [`crate::network::Shape::parts`], so a model can be read back and trained on.

mod encode;
mod graph;
mod model;
mod read;
mod write;

pub use model::{Metadata, Model};
