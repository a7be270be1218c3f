//! What the training needs of an environment.

use rand_pcg::Pcg64Mcg;

use crate::error::Result;

use super::State;

/// An episode: a tour under construction in one scenario (paper, section 5.3).
pub trait Episode: Clone + Send + Sync {
    /// What the Q-network sees, and the actions that are legal.
    fn state(&self) -> State;

    /// Inserts the candidate of that row and gives the reward. The last reward of an episode includes what a
    /// failure costs.
    fn act(&mut self, row: usize) -> f32;

    /// Whether the stop function holds, or no action is left.
    fn is_over(&self) -> bool;

    /// What was reached, once it is over.
    fn outcome(&self) -> Outcome;
}

/// The end of an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Whether the tour keeps every constraint.
    pub feasible: bool,
    /// The objective f, to be maximised, in the units of the scenario.
    pub objective: f64,
}

/// Where episodes come from.
pub trait Source: Sync {
    /// Their kind.
    type Episode: Episode;

    /// An episode at its beginning; not over yet.
    ///
    /// # Errors
    /// No scenario can be drawn.
    fn draw(&self, rng: &mut Pcg64Mcg) -> Result<Self::Episode>;
}
