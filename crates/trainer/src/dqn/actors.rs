//! [`Actors`]: episodes that are played side by side by the epsilon-greedy policy.

use std::sync::Arc;

use rayon::prelude::*;

use crate::network::Network;

use super::random::{index, stream, unit};
use super::{Play, Pool, Trajectory, best};

const DRAWS: u64 = 1;
const PLAY: u64 = 2;

/// Episodes that are played side by side; each that ends is followed by a new one.
pub struct Actors<'a> {
    actors: Vec<Actor<'a>>,
    seed: u64,
    rounds: u64,
}

/// One of them.
#[derive(Clone)]
struct Actor<'a> {
    play: Play<'a>,
    trajectory: Trajectory,
    episodes: u64,
}

impl<'a> Actors<'a> {
    /// `count` episodes at their beginnings. `rounds` were played before: their random numbers are not used again.
    pub fn new(pool: &Pool<'a>, count: usize, seed: u64, rounds: u64) -> Self {
        let begin = |i| {
            let play = pool.draw(&mut stream(seed, DRAWS, number(i, rounds)));
            Actor { play, trajectory: Trajectory::default(), episodes: rounds }
        };
        Self { actors: (0..count).map(begin).collect(), seed, rounds }
    }

    /// Takes one step in every episode, and gives those that ended by it.
    /// Its last reward then counts what `orders` other orders of its stops would win.
    pub fn step(
        &mut self,
        pool: &Pool<'a>,
        network: &Network,
        epsilon: f64,
        orders: usize,
    ) -> Vec<Trajectory> {
        self.rounds += 1;
        let (seed, rounds) = (self.seed, self.rounds);
        let play = |(i, actor): (usize, &mut Actor<'a>)| {
            let mut rng = stream(seed, PLAY, number(i, rounds));
            let encoding = Arc::new(actor.play.encode());
            let explores = unit(&mut rng) < epsilon;
            let row = if explores {
                let rows: Vec<usize> =
                    (0..encoding.rows()).filter(|row| encoding.actions[*row].is_some()).collect();
                rows.get(index(&mut rng, rows.len())).copied()
            } else {
                best(&encoding, &network.values_of(&encoding))
            };
            if let Some(row) = row {
                let reward = actor.play.act(&encoding, row);
                actor.trajectory.push(encoding, row as u32, reward);
                if !actor.play.episode.is_over() {
                    return None;
                }
            }
            actor.trajectory.add(actor.play.reordered(orders, &mut rng));
            actor.episodes += 1;
            actor.play = pool.draw(&mut stream(seed, DRAWS, number(i, actor.episodes)));
            Some(std::mem::take(&mut actor.trajectory))
        };
        let ended: Vec<Option<Trajectory>> =
            self.actors.par_iter_mut().enumerate().map(play).collect();
        ended.into_iter().flatten().collect()
    }

    /// Steps that were taken in every episode.
    pub fn rounds(&self) -> u64 {
        self.rounds
    }

    /// The episode of the `i`-th actor, counted around.
    pub fn play(&self, i: u64) -> &Play<'a> {
        &self.actors[(i % self.actors.len() as u64) as usize].play
    }
}

/// One number for an actor and a count.
fn number(actor: usize, count: u64) -> u64 {
    (actor as u64) << 40 | count
}
