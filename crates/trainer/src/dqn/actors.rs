//! [`Actors`]: episodes that are played side by side by the epsilon-greedy policy.

use std::sync::Arc;

use rayon::prelude::*;

use crate::error::Result;
use crate::network::Network;

use super::random::{index, stream, unit};
use super::{Episode, Source, Trajectory, best};

const DRAWS: u64 = 1;
const PLAY: u64 = 2;

/// Episodes that are played side by side; each that ends is followed by a new one.
pub struct Actors<E> {
    actors: Vec<Actor<E>>,
    seed: u64,
    rounds: u64,
}

/// One of them.
#[derive(Clone)]
struct Actor<E> {
    episode: E,
    trajectory: Trajectory,
    episodes: u64,
}

impl<E: Episode> Actors<E> {
    /// `count` episodes at their beginnings. `rounds` were played before: their random numbers are not used again.
    pub fn new<S: Source<Episode = E>>(source: &S, count: usize, seed: u64, rounds: u64) -> Result<Self> {
        let draw = |i: usize| {
            let mut rng = stream(seed, DRAWS, mix(i, rounds));
            Ok(Actor { episode: source.draw(&mut rng)?, trajectory: Trajectory::default(), episodes: rounds })
        };
        let actors = (0..count).into_par_iter().map(draw).collect::<Result<_>>()?;
        Ok(Self { actors, seed, rounds })
    }

    /// Takes one step in every episode, and gives those that ended by it.
    pub fn step<S: Source<Episode = E>>(
        &mut self,
        source: &S,
        network: &Network,
        epsilon: f64,
    ) -> Result<Vec<Trajectory>> {
        self.rounds += 1;
        let (seed, rounds) = (self.seed, self.rounds);
        let play = |(i, actor): (usize, &mut Actor<E>)| {
            let mut rng = stream(seed, PLAY, mix(i, rounds));
            let state = Arc::new(actor.episode.state());
            let chosen = if unit(&mut rng) < epsilon {
                state.actions.get(index(&mut rng, state.actions.len())).copied()
            } else {
                best(&state, &network.values_of(&state.nodes, &state.edges))
            };
            if let Some(action) = chosen {
                let reward = actor.episode.act(action as usize);
                actor.trajectory.push(state, action, reward);
                if !actor.episode.is_over() {
                    return Ok(None);
                }
            }
            actor.episodes += 1;
            actor.episode = source.draw(&mut stream(seed, DRAWS, mix(i, actor.episodes)))?;
            Ok(Some(std::mem::take(&mut actor.trajectory)))
        };
        let ended: Vec<Option<Trajectory>> =
            self.actors.par_iter_mut().enumerate().map(play).collect::<Result<_>>()?;
        Ok(ended.into_iter().flatten().collect())
    }

    /// Steps that were taken in every episode.
    pub fn rounds(&self) -> u64 {
        self.rounds
    }

    /// The episode of the `i`-th actor, counted around.
    pub fn episode(&self, i: u64) -> &E {
        &self.actors[(i % self.actors.len() as u64) as usize].episode
    }
}

/// One number for an actor and a count.
fn mix(actor: usize, count: u64) -> u64 {
    (actor as u64) << 40 | count
}
