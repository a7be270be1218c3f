//! The construction as shipped: which roll-outs, in which order, under a budget.

use rand_pcg::Pcg64Mcg;

use super::{Guide, Kept, reinsert};
use crate::framework::Episode;
use crate::policy::{Problem, QError};
use crate::solvers::Budget;

/// How much is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Whether there is a greedy roll-out, the first.
    pub greedy: bool,
    /// Width of the beam; 0 for none.
    pub beam: usize,
    /// Sampled roll-outs.
    pub samples: usize,
    /// Temperature of the samples, in the units of the Q-function.
    pub temperature: f64,
    /// Actions of the look-ahead; 0 for none.
    pub look_ahead: usize,
    /// Random orders in which the stops of each complete tour are put in again.
    pub orders: usize,
}

impl Effort {
    /// Nothing but one greedy roll-out.
    pub const GREEDY: Self =
        Self { greedy: true, beam: 0, samples: 0, temperature: 0.0, look_ahead: 0, orders: 0 };

    /// What `auto` begins with: eight roll-outs.
    pub const SHARE: Self =
        Self { greedy: true, beam: 7, samples: 0, temperature: 0.1, look_ahead: 0, orders: 16 };

    /// What the solver `dqn` does: at most 32 complete roll-outs. Where demands have to be met by their
    /// deadlines, the order is most of what is left to win, and another one costs little.
    pub const fn whole(problem: Problem) -> Self {
        let orders = match problem {
            Problem::KCoverage => 96,
            Problem::Reward | Problem::Mobile => 16,
        };
        Self { beam: 15, samples: 16, orders, ..Self::SHARE }
    }
}

/// Sampled roll-outs that go side by side.
const SIDE_BY_SIDE: usize = 16;

impl<'a> Guide<'a> {
    /// Builds tours and keeps the best in `kept`; a roll-out is an iteration of the budget. The budget ends
    /// it between two phases, or two batches of samples.
    ///
    /// # Errors
    /// The Q-function cannot answer; what was built before is kept.
    pub fn construct(
        &self,
        effort: Effort,
        rng: &mut Pcg64Mcg,
        budget: &mut Budget<'_>,
        kept: &mut Kept,
    ) -> Result<(), QError> {
        if effort.greedy {
            let mut ends = vec![self.begin()];
            self.greedy(&mut ends)?;
            self.complete(&ends, effort, rng, budget, kept);
        }
        if effort.beam > 0 && !budget.is_spent() {
            let ends = self.beam(effort.beam)?;
            self.complete(&ends, effort, rng, budget, kept);
        }
        if effort.look_ahead > 0 && !budget.is_spent() {
            let ends = self.look_ahead(effort.look_ahead)?;
            self.complete(&ends, effort, rng, budget, kept);
        }
        let mut samples = effort.samples;
        while samples > 0 && !budget.is_spent() {
            let count = samples.min(SIDE_BY_SIDE);
            samples -= count;
            let mut ends = vec![self.begin(); count];
            self.sample(&mut ends, effort.temperature, rng)?;
            self.complete(&ends, effort, rng, budget, kept);
        }
        Ok(())
    }

    /// Keeps the best of some episodes that are over, and of the other orders of their stops.
    fn complete(
        &self,
        ends: &[Episode<'a>],
        effort: Effort,
        rng: &mut Pcg64Mcg,
        budget: &mut Budget<'_>,
        kept: &mut Kept,
    ) {
        ends.iter().for_each(|end| kept.finished(end));
        for end in ends {
            if !budget.spend() {
                return;
            }
            reinsert(self.instance, self.definition, end.order(), effort.orders, rng, kept);
        }
    }
}
