//! [`Model`]: a policy and what is known of it.

use std::path::Path;

use prost::Message;
use tract_onnx::pb::ModelProto;

use crate::error::{Error, Result};
use crate::file::write_atomically;
use crate::network::Weights;

use super::{read, write};

/// What a model says of itself, beside the feature version and the shape of the network.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Which problem its policy plans: `k_coverage`, `reward` or `mobile`.
    pub problem: String,
    /// How it was trained, a JSON object: command, seed, steps, hyper-parameters.
    pub training: String,
    /// How good it was found, a JSON object.
    pub evaluation: String,
}

/// A policy and what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The parameters of its Q-network.
    pub weights: Weights,
    /// What is known of it.
    pub metadata: Metadata,
}

impl Model {
    /// The bytes of an ONNX file; the same model, the same bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        write::model(self).encode_to_vec()
    }

    /// The model of an ONNX file that [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// What is wrong with it, in words: no ONNX, other features, a parameter missing or not finite.
    pub fn from_bytes(bytes: &[u8]) -> std::result::Result<Self, String> {
        let model = ModelProto::decode(bytes).map_err(|e| format!("no ONNX model: {e}"))?;
        read::model(&model)
    }

    /// Writes the model; a reader sees the old file or the new one, never half of one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path) -> Result<()> {
        write_atomically(path, &self.to_bytes())
    }

    /// Reads a model.
    ///
    /// # Errors
    /// The file cannot be read, or is no model of these features.
    pub fn load(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path).map_err(Error::file(path))?;
        Self::from_bytes(&bytes).map_err(|reason| Error::format(path, reason))
    }
}
