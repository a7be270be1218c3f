//! [`Learner`]: steps the parameters towards the targets of a batch.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use voltour_solver::policy::{Batch, Encoding};

use crate::error::{Error, Result};
use crate::network::{Differentiable, Network, Target, Weights};

use super::{Adam, Options, Sample, clip, learning_rate};

/// Where gradients are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Device {
    /// This machine's processor.
    #[default]
    Cpu,
    /// An NVIDIA GPU; needs a build with the feature `cuda`.
    Cuda,
}

impl Device {
    /// The device in burn.
    ///
    /// # Errors
    /// This build has no such device.
    pub fn open(self) -> Result<burn::tensor::Device> {
        match self {
            Self::Cpu => Ok(burn::tensor::Device::flex()),
            #[cfg(feature = "cuda")]
            Self::Cuda => Ok(burn::tensor::Device::cuda(0)),
            #[cfg(not(feature = "cuda"))]
            Self::Cuda => {
                Err(Error::Device("this build has no cuda; build with --features cuda".to_owned()))
            }
        }
    }
}

/// The parameters in training, and what steps them.
#[derive(Clone, Debug)]
pub struct Learner {
    /// The network that acts.
    pub network: Network,
    /// The running mean of its parameters (Polyak and Juditsky 1992): steps jump about, their mean does not.
    pub average: Network,
    /// The target network of n-step targets.
    pub target: Network,
    /// The moments of the gradients.
    pub adam: Adam,
    differentiable: Differentiable,
}

impl Learner {
    /// A learner that begins with these parameters.
    ///
    /// # Errors
    /// The device cannot be opened.
    pub fn new(weights: Weights, device: Device) -> Result<Self> {
        let differentiable = Differentiable::new(device.open()?);
        let adam = Adam::new(weights.values().len());
        let network = Network::new(weights);
        Ok(Self {
            average: network.clone(),
            target: network.clone(),
            network,
            adam,
            differentiable,
        })
    }

    /// One gradient step: `y = rewards + max Q(s')` by a double DQN, Huber's loss, clipped Adam. Gives the mean
    /// loss of a sample.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn learn(&mut self, samples: &[&Sample], options: &Options) -> Result<f64> {
        let step = self.adam.steps;
        let finite =
            |what, holds| if holds { Ok(()) } else { Err(Error::NotFinite { what, step }) };
        let after = self.bootstraps(samples);
        let mut order: Vec<usize> = (0..samples.len()).collect();
        order.sort_by_key(|i| samples[*i].state.rows());
        let mut gradient = vec![0.0; self.network.weights().values().len()];
        let mut loss = 0.0;
        for group in order.chunks(samples.len().div_ceil(options.groups).max(1)) {
            let batch = Batch::pack(group.iter().map(|i| &*samples[*i].state));
            let mut target = Target {
                values: vec![0.0; batch.mask.len()],
                weights: vec![0.0; batch.mask.len()],
                differences: options.differences,
            };
            for (row, i) in group.iter().enumerate() {
                let labels = &samples[*i].labels;
                for (action, rewards) in labels {
                    let at = row * batch.rows + *action as usize;
                    target.values[at] = rewards + after[*i];
                    target.weights[at] = 1.0 / (labels.len() * samples.len()) as f32;
                }
            }
            target.differences *=
                f32::from(u8::from(group.iter().any(|i| samples[*i].labels.len() > 1)));
            finite("a target", target.values.iter().all(|y| y.is_finite()))?;
            let (part, slope) =
                self.differentiable.gradient(self.network.weights(), &batch, &target)?;
            loss += f64::from(part);
            gradient.iter_mut().zip(slope).for_each(|(sum, g)| *sum += g);
        }
        options.blind(&mut gradient)?;
        finite("the loss", loss.is_finite())?;
        finite("the gradient", clip(&mut gradient, options.clip).is_finite())?;
        let rate = learning_rate(options, step as f64 / options.steps as f64);
        self.adam.step(self.network.weights_mut().values_mut(), &gradient, rate);
        finite("a parameter", self.network.weights().is_finite())?;
        self.blend(options.average);
        if self.adam.steps.is_multiple_of(options.target_every) {
            self.target = self.network.clone();
        }
        Ok(loss)
    }

    /// Moves the mean towards the parameters; at first quickly, so that it forgets where they began.
    fn blend(&mut self, keep: f64) {
        let steps = self.adam.steps as f64;
        let keep = keep.min(steps / (steps + 10.0)) as f32;
        let mean = self.average.weights_mut().values_mut().iter_mut();
        mean.zip(self.network.weights().values())
            .for_each(|(m, w)| *m = keep * *m + (1.0 - keep) * w);
    }

    /// For each sample the value of the state after it: the target network's, of the action that the acting
    /// network finds best (van Hasselt, Guez and Silver 2016); 0 where nothing follows.
    fn bootstraps(&self, samples: &[&Sample]) -> Vec<f32> {
        let value = |state: &Encoding| {
            let row = super::best(state, &self.network.values_of(state));
            row.map_or(0.0, |row| self.target.values_of(state)[row])
        };
        samples.par_iter().map(|s| s.bootstrap.as_deref().map_or(0.0, value)).collect()
    }
}
