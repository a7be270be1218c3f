//! [`Checkpoint`]: a training as a file, to go on with after an interruption: safetensors, whose metadata hold the
//! options and the learning curve.

use std::collections::HashMap;
use std::path::Path;

use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::dqn::{Adam, Device, Learner, Options};
use crate::error::{Error, Result};
use crate::file::write_atomically;
use crate::network::{Network, Weights};
use crate::onnx::{Metadata, Model};
use crate::report::Point;

const KEY: &str = "voltour.training";

/// A training between two steps. The replay memory is not part of it: it is filled anew.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What is not an array.
    pub run: Run,
    /// The parameters.
    pub weights: Weights,
    /// Their running mean.
    pub average: Weights,
    /// The parameters of the target network.
    pub target: Weights,
    /// The mean parameters that did best in validation.
    pub best: Weights,
    /// The moments of the gradients.
    pub adam: Adam,
}

/// What a checkpoint knows beside the parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The problem.
    pub problem: String,
    /// The command line.
    pub command: String,
    /// The hyper-parameters.
    pub options: Options,
    /// Gradient steps taken.
    pub steps: u64,
    /// Steps taken in every episode.
    pub rounds: u64,
    /// Seconds of training.
    pub seconds: f64,
    /// The learning curve so far.
    pub curve: Vec<Point>,
}

impl Checkpoint {
    /// Writes the checkpoint; the file is the old one or the new one, never half of one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path) -> Result<()> {
        let arrays = [
            ("weights", self.weights.values()),
            ("average", self.average.values()),
            ("target", self.target.values()),
            ("best", self.best.values()),
            ("adam.first", &self.adam.first),
            ("adam.second", &self.adam.second),
        ];
        let bytes = arrays.map(|(name, values)| (name, little_endian(values)));
        let mut views = Vec::with_capacity(bytes.len());
        for (name, bytes) in &bytes {
            let view = TensorView::new(Dtype::F32, vec![bytes.len() / 4], bytes);
            views.push((*name, view.map_err(|e| Error::format(path, e))?));
        }
        let run = serde_json::to_string(&self.run).map_err(|e| Error::format(path, e))?;
        let metadata = HashMap::from([(KEY.to_owned(), run)]);
        let file =
            safetensors::serialize(views, Some(metadata)).map_err(|e| Error::format(path, e))?;
        write_atomically(path, &file)
    }

    /// Reads a checkpoint.
    ///
    /// # Errors
    /// The file cannot be read, or is no checkpoint.
    pub fn load(path: &Path) -> Result<Self> {
        let file = std::fs::read(path).map_err(Error::file(path))?;
        Self::read(&file).map_err(|reason| Error::format(path, reason))
    }

    /// The model of the best network, or of the last.
    pub fn model(&self, last: bool) -> Model {
        let Run { options, steps, seconds, curve, .. } = &self.run;
        let best = curve.iter().min_by(|a, b| a.cost().total_cmp(&b.cost()));
        let taken = if last { curve.last() } else { best };
        let training = json!({
            "command": self.run.command,
            "seed": options.seed,
            "steps": taken.map_or(*steps, |point| point.step),
            "seconds": seconds.round(),
            "options": options,
        });
        let evaluation = taken.map_or_else(|| json!({}), |point| json!({ "validation": point }));
        let metadata = Metadata {
            problem: self.run.problem.clone(),
            training: training.to_string(),
            evaluation: evaluation.to_string(),
        };
        let weights = if last { &self.average } else { &self.best };
        Model { weights: weights.clone(), metadata }
    }

    /// The learner to go on with.
    ///
    /// # Errors
    /// The device cannot be opened.
    pub fn learner(&self, device: Device) -> Result<Learner> {
        let mut learner = Learner::new(self.weights.clone(), device)?;
        learner.average = Network::new(self.average.clone());
        learner.target = Network::new(self.target.clone());
        learner.adam = self.adam.clone();
        Ok(learner)
    }

    fn read(file: &[u8]) -> std::result::Result<Self, String> {
        let (_, header) = SafeTensors::read_metadata(file).map_err(|e| e.to_string())?;
        let text =
            header.metadata().as_ref().and_then(|m| m.get(KEY)).ok_or(format!("no {KEY}"))?;
        let run: Run = serde_json::from_str(text).map_err(|e| format!("{KEY}: {e}"))?;
        let shape = run.options.shape().checked().map_err(|e| e.to_string())?;
        let tensors = SafeTensors::deserialize(file).map_err(|e| e.to_string())?;
        let array = |name: &str| {
            let view = tensors.tensor(name).map_err(|e| format!("{name}: {e}"))?;
            let (chunks, _) = view.data().as_chunks::<4>();
            let values: Vec<f32> = chunks.iter().map(|b| f32::from_le_bytes(*b)).collect();
            match values.len() == shape.parameters() && values.iter().all(|v| v.is_finite()) {
                true => Ok(values),
                false => Err(format!("{name} does not hold {} finite numbers", shape.parameters())),
            }
        };
        let weights = |name: &str| {
            Weights::from_values(shape.clone(), array(name)?)
                .ok_or_else(|| format!("{name}: wrong size"))
        };
        let adam =
            Adam { first: array("adam.first")?, second: array("adam.second")?, steps: run.steps };
        Ok(Self {
            weights: weights("weights")?,
            average: weights("average")?,
            target: weights("target")?,
            best: weights("best")?,
            adam,
            run,
        })
    }
}

fn little_endian(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}
