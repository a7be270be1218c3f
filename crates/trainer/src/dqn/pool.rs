//! [`Pool`]: the instances that are played on, and [`Play`], an episode on one of them.

use std::sync::Arc;

use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use voltour_solver::framework::{Episode, definition};
use voltour_solver::instance::Instance;
use voltour_solver::policy::guided::{Kept, reinsert};
use voltour_solver::policy::{Encoder, Encoding, Problem};
use voltour_solver::scenario::Objective;

use crate::error::{Error, Result};

use super::random::unit;

/// An episode with the encoder of its instance.
#[derive(Clone)]
pub struct Play<'a> {
    /// The episode.
    pub episode: Episode<'a>,
    encoder: Arc<Encoder>,
}

impl<'a> Play<'a> {
    /// An episode at its beginning.
    pub fn new(instance: &'a Instance<'a>, problem: Problem) -> Self {
        let episode = Episode::new(instance, definition(problem));
        let encoder = Arc::new(Encoder::new(episode.state()));
        Self { episode, encoder }
    }

    /// What the best of `orders` random orders of its stops would win over its own, in the units of its rewards;
    /// nothing before it has succeeded.
    pub fn reordered(&self, orders: usize, rng: &mut Pcg64Mcg) -> f32 {
        let state = self.episode.state();
        if orders == 0 || !self.episode.succeeded() {
            return 0.0;
        }
        let (instance, definition) = (state.instance(), self.episode.definition());
        let mut kept = Kept::nothing(instance);
        kept.offer(instance, state.tour());
        let own = kept.value.cost;
        reinsert(instance, definition, self.episode.order(), orders, rng, &mut kept);
        let unit = match instance.scenario.objective {
            Objective::MinDistance => state.scales().length_m,
            Objective::MaxReward => state.scales().gain,
            Objective::MaxCount => 1.0,
        };
        ((own - kept.value.cost) / unit).max(0.0) as f32
    }

    /// What the Q-network sees.
    pub fn encode(&self) -> Encoding {
        self.encoder.encode(&self.episode)
    }

    /// Takes the action of a row of the encoding and gives the reward.
    pub fn act(&mut self, encoding: &Encoding, row: usize) -> f32 {
        let action = encoding.actions.get(row).copied().flatten();
        action.map_or(0.0, |index| self.episode.act(index as usize) as f32)
    }
}

/// The instances that are played on. One with more candidates is drawn more often, in proportion: it is where
/// there is more to learn.
pub struct Pool<'a> {
    plays: Vec<Play<'a>>,
    cumulative: Vec<f64>,
}

impl<'a> Pool<'a> {
    /// The instances whose episodes are not over at their beginning.
    ///
    /// # Errors
    /// There is none.
    pub fn new(instances: &'a [Instance<'a>], problem: Problem) -> Result<Self> {
        let mut plays: Vec<Play<'a>> =
            instances.par_iter().map(|instance| Play::new(instance, problem)).collect();
        plays.retain(|play| !play.episode.is_over());
        let mut sum = 0.0;
        let weigh = |play: &Play<'_>| {
            sum += play.episode.state().useful().len() as f64;
            sum
        };
        let cumulative: Vec<f64> = plays.iter().map(weigh).collect();
        match plays.is_empty() {
            true => Err(Error::Scenario("none leaves anything to decide".to_owned())),
            false => Ok(Self { plays, cumulative }),
        }
    }

    /// The number of instances.
    pub fn len(&self) -> usize {
        self.plays.len()
    }

    /// Whether there is none; never.
    pub fn is_empty(&self) -> bool {
        self.plays.is_empty()
    }

    /// An episode at its beginning.
    pub fn draw(&self, rng: &mut Pcg64Mcg) -> Play<'a> {
        let point = unit(rng) * self.cumulative.last().copied().unwrap_or(0.0);
        let i = self.cumulative.partition_point(|sum| *sum <= point);
        self.plays[i.min(self.plays.len() - 1)].clone()
    }
}
