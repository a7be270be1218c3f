//! [`Training`]: Algorithm 1 of the paper.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::network::Weights;

use super::actors::Actors;
use super::random::stream;
use super::rollouts::rollouts;
use super::{Device, Learner, Options, Play, Pool, Replay, Sample, Targets, epsilon};

const BATCHES: u64 = 3;
const ROLLOUTS: u64 = 4;

/// A training in progress.
pub struct Training<'a> {
    /// What it follows.
    pub options: Options,
    /// The parameters.
    pub learner: Learner,
    pool: Pool<'a>,
    actors: Actors<'a>,
    replay: Replay,
    tried: Replay,
    demonstrations: Vec<Sample>,
}

/// How the training went in its last iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Gradient steps so far.
    pub step: u64,
    /// Mean loss of a sample; none before the first gradient step.
    pub loss: Option<f64>,
    /// The share of random actions.
    pub epsilon: f64,
    /// Mean sum of the rewards of the episodes that ended; none if none did.
    pub total: Option<f64>,
}

impl<'a> Training<'a> {
    /// A training that begins with random parameters.
    ///
    /// # Errors
    /// An option has no meaning, or the device cannot be opened.
    pub fn new(options: Options, pool: Pool<'a>, device: Device) -> Result<Self> {
        let mut weights = Weights::random(options.shape(), options.seed);
        options.blind(weights.values_mut())?;
        Self::resume(options, pool, Learner::new(weights, device)?, 0)
    }

    /// A training that goes on with a learner after `rounds` steps of its episodes. The replay memory is empty and
    /// filled anew by the policy as it is.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn resume(options: Options, pool: Pool<'a>, learner: Learner, rounds: u64) -> Result<Self> {
        let options = options.checked()?;
        let actors = Actors::new(&pool, options.episodes, options.seed, rounds);
        let (replay, tried) = (Replay::new(options.replay), Replay::new(options.rollout_replay));
        Ok(Self { options, learner, pool, actors, replay, tried, demonstrations: Vec::new() })
    }

    /// Tours of the exact solver to learn from.
    pub fn demonstrate(&mut self, samples: Vec<Sample>) {
        self.demonstrations = samples;
    }

    /// Whether all steps are taken.
    pub fn is_over(&self) -> bool {
        self.learner.adam.steps >= self.options.steps
    }

    /// Steps that were taken in every episode.
    pub fn rounds(&self) -> u64 {
        self.actors.rounds()
    }

    /// One step of every episode, then some gradient steps.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn advance(&mut self) -> Result<Progress> {
        let options = &self.options;
        let epsilon = epsilon(options, self.learner.adam.steps as f64 / options.steps as f64);
        let horizon = match options.targets {
            Targets::Mc => None,
            Targets::NStep => Some(options.horizon),
        };
        let ended = self.actors.step(&self.pool, &self.learner.network, epsilon, options.orders);
        for sample in ended.iter().flat_map(|trajectory| trajectory.samples(horizon)) {
            if !sample.state.nodes.iter().all(|f| f.is_finite()) {
                return Err(Error::NotFinite { what: "a feature", step: self.learner.adam.steps });
            }
            self.replay.push(sample);
        }
        let total = ended.iter().map(|t| f64::from(t.total())).sum::<f64>() / ended.len() as f64;
        let loss = if self.replay.len() < options.warm_up.max(1) { None } else { self.update()? };
        let total = (!ended.is_empty()).then_some(total);
        Ok(Progress { step: self.learner.adam.steps, loss, epsilon, total })
    }

    /// The gradient steps of an iteration; gives their mean loss.
    fn update(&mut self) -> Result<Option<f64>> {
        self.try_out();
        let options = &self.options;
        let (mut sum, mut steps) = (0.0, 0);
        for _ in 0..options.updates {
            if self.is_over() {
                break;
            }
            let mut rng = stream(options.seed, BATCHES, self.learner.adam.steps);
            let shown = (options.demonstrations * options.batch as f64).round() as usize;
            let shown = if self.demonstrations.is_empty() { 0 } else { shown };
            let mut samples: Vec<&Sample> =
                self.replay.draw(options.batch - shown, &mut rng).collect();
            samples.extend((0..shown).map(|_| {
                &self.demonstrations[super::random::index(&mut rng, self.demonstrations.len())]
            }));
            samples.extend(self.tried.draw(options.rollout_batch, &mut rng));
            sum += self.learner.learn(&samples, options)?;
            steps += 1;
        }
        Ok((steps > 0).then(|| sum / f64::from(steps)))
    }

    /// Roll-outs of the states in which some episodes are now.
    fn try_out(&mut self) {
        let (options, round) = (&self.options, self.actors.rounds());
        let count = options.rollout_states as u64;
        let plays: Vec<Play<'a>> =
            (0..count).map(|i| self.actors.play(round * count + i).clone()).collect();
        let mut rng = stream(options.seed, ROLLOUTS, round);
        let samples = rollouts(&self.learner.network, &plays, options, &mut rng);
        samples.into_iter().for_each(|sample| self.tried.push(sample));
    }
}
