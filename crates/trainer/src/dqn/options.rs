//! [`Options`]: every hyper-parameter, with the values that were found good.

use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};

use voltour_solver::policy::Feature;

use crate::error::{Error, Result};
use crate::network::Shape;

/// What the values of actions are trained towards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Targets {
    /// The return of the whole episode.
    Mc,
    /// The rewards of the next steps, then a double DQN's value.
    NStep,
}

/// The hyper-parameters of a training.
#[derive(Clone, Debug, PartialEq, Args, Serialize, Deserialize)]
#[command(next_help_heading = "Hyper-parameters")]
pub struct Options {
    /// Gradient steps.
    #[arg(long, default_value_t = 9_300)]
    pub steps: u64,
    /// Seed of the weights, the scenarios and the play.
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Samples a gradient step.
    #[arg(long, default_value_t = 32)]
    pub batch: usize,
    /// Groups of like size that a batch is padded in.
    #[arg(long, default_value_t = 2)]
    pub groups: usize,
    /// Episodes that are played side by side.
    #[arg(long, default_value_t = 32)]
    pub episodes: usize,
    /// Gradient steps after each step of all episodes.
    #[arg(long, default_value_t = 4)]
    pub updates: u64,
    /// Samples in the replay memory.
    #[arg(long, default_value_t = 15_000)]
    pub replay: usize,
    /// Samples in the replay memory before the first gradient step.
    #[arg(long, default_value_t = 1_000)]
    pub warm_up: usize,
    /// What values are trained towards.
    #[arg(long, value_enum, default_value_t = Targets::Mc)]
    pub targets: Targets,
    /// Steps of rewards before the value of a state is taken (n-step targets).
    #[arg(long, default_value_t = 3)]
    pub horizon: usize,
    /// Gradient steps between copies of the network into the target network (n-step targets).
    #[arg(long, default_value_t = 500)]
    pub target_every: u64,
    /// Random orders in which the stops of an episode are put in again; what the best of them wins counts as
    /// the last reward, as the search on top of the policy would have it.
    #[arg(long, default_value_t = 0)]
    pub orders: usize,
    /// Epsilon at the beginning.
    #[arg(long, default_value_t = 1.0)]
    pub epsilon_start: f64,
    /// Epsilon once exploration is over.
    #[arg(long, default_value_t = 0.05)]
    pub epsilon_end: f64,
    /// Share of the run in which epsilon falls.
    #[arg(long, default_value_t = 0.24)]
    pub explore: f64,
    /// Adam's rate.
    #[arg(long, default_value_t = 1e-3)]
    pub learning_rate: f64,
    /// Share of the run in which the rate is constant; then it falls linearly.
    #[arg(long, default_value_t = 0.5)]
    pub hold: f64,
    /// The rate at the end, as a share of the first.
    #[arg(long, default_value_t = 0.05)]
    pub rate_end: f64,
    /// Share of the averaged parameters that each step keeps; the average is what is validated and exported. 0: none.
    #[arg(long, default_value_t = 0.999)]
    pub average: f64,
    /// Longest gradient, by its norm.
    #[arg(long, default_value_t = 1.0)]
    pub clip: f64,
    /// Episodes, of those played, in whose states several actions are tried out at each step.
    #[arg(long, default_value_t = 0)]
    pub rollout_states: usize,
    /// Actions tried out: the best by value.
    #[arg(long, default_value_t = 4)]
    pub rollout_best: usize,
    /// Actions tried out: others, at random.
    #[arg(long, default_value_t = 2)]
    pub rollout_random: usize,
    /// States with several tried actions beside each batch.
    #[arg(long, default_value_t = 4)]
    pub rollout_batch: usize,
    /// States with several tried actions that are remembered.
    #[arg(long, default_value_t = 2_000)]
    pub rollout_replay: usize,
    /// Weight of the errors of differences between the actions of a state.
    #[arg(long, default_value_t = 1.0)]
    pub differences: f32,
    /// Share of each batch that comes from demonstrations.
    #[arg(long, default_value_t = 0.0)]
    pub demonstrations: f64,
    /// Features that the network does not see, such as Regret,Loses.
    #[arg(long, value_delimiter = ',', value_name = "FEATURE")]
    pub without: Vec<String>,
    /// Width of an embedding, p.
    #[arg(long, default_value_t = 64)]
    pub width: usize,
    /// Rounds of messages, T.
    #[arg(long, default_value_t = 3)]
    pub rounds: usize,
    /// Scale of each message kernel, in units of the mean travel time.
    #[arg(long, value_delimiter = ',', default_values_t = [0.15, 0.5])]
    pub kernels: Vec<f32>,
}

impl Options {
    /// The options of a command line that names none.
    pub fn defaults() -> Self {
        #[derive(clap::Parser)]
        struct Bare {
            #[command(flatten)]
            options: Options,
        }
        let bare: Bare = clap::Parser::parse_from([""; 0]);
        bare.options
    }

    /// The size of the network.
    pub fn shape(&self) -> Shape {
        Shape { width: self.width, rounds: self.rounds, kernels: self.kernels.clone() }
    }

    /// Sets to 0, among the parameters or their gradient, those that would read a feature which the network does
    /// not see. What is added to the output, the reward, stays known.
    ///
    /// # Errors
    /// A name is no feature's.
    pub fn blind(&self, parameters: &mut [f32]) -> Result<()> {
        for name in &self.without {
            let row = Feature::ALL.iter().position(|f| f.name().eq_ignore_ascii_case(name));
            let rule = "must be a feature of crates/solver/src/policy/feature.rs";
            let row = row.ok_or(Error::Option { name: "without", value: name.clone(), rule })?;
            // The input's matrix comes first, a row a feature.
            parameters[row * self.width..(row + 1) * self.width].fill(0.0);
        }
        Ok(())
    }

    /// The options, if a training can follow them.
    ///
    /// # Errors
    /// The first option that is outside its range.
    pub fn checked(self) -> Result<Self> {
        self.shape().checked()?;
        self.blind(&mut vec![0.0; self.shape().parameters()])?;
        for (name, value) in [
            ("steps", self.steps),
            ("updates", self.updates),
            ("batch", self.batch as u64),
            ("groups", self.groups as u64),
            ("episodes", self.episodes as u64),
            ("replay", self.replay as u64),
            ("horizon", self.horizon as u64),
            ("target-every", self.target_every),
        ] {
            hold(name, value, "must be at least 1", value > 0)?;
        }
        hold("warm-up", self.warm_up, "must be at most --replay", self.warm_up <= self.replay)?;
        for (name, value) in [
            ("epsilon-start", self.epsilon_start),
            ("epsilon-end", self.epsilon_end),
            ("explore", self.explore),
            ("hold", self.hold),
            ("rate-end", self.rate_end),
            ("average", self.average),
            ("demonstrations", self.demonstrations),
        ] {
            hold(name, value, "must be in [0, 1]", (0.0..=1.0).contains(&value))?;
        }
        for (name, value) in [("learning-rate", self.learning_rate), ("clip", self.clip)] {
            hold(name, value, "must be positive", value > 0.0 && value.is_finite())?;
        }
        let differences = self.differences >= 0.0 && self.differences.is_finite();
        hold("differences", self.differences, "must be 0 or more", differences)?;
        Ok(self)
    }
}

fn hold(name: &'static str, value: impl ToString, rule: &'static str, holds: bool) -> Result<()> {
    if holds { Ok(()) } else { Err(Error::Option { name, value: value.to_string(), rule }) }
}
