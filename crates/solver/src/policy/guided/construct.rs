//! The construction as shipped: which roll-outs, in which order, under a budget.

use rand_pcg::Pcg64Mcg;

use super::{Guide, Kept, reinsert};
use crate::framework::Episode;
use crate::policy::{Problem, QError};
use crate::solvers::Budget;

/// How much is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Actions that the greedy roll-out, the first, takes in each state that it values; 0 for none.
    pub greedy: usize,
    /// Width of the beam; 0 for none.
    pub beam: usize,
    /// Sampled roll-outs.
    pub samples: usize,
    /// Temperature of the samples, in the units of the Q-function.
    pub temperature: f64,
    /// Actions of the look-ahead; 0 for none.
    pub look_ahead: usize,
    /// Orders in which the stops of each complete tour are put in again.
    pub orders: usize,
    /// Whether a tour of n stops has n^2 orders where that is more; beyond 32 stops they become fewer again.
    pub orders_grow: bool,
}

impl Effort {
    /// Nothing but one greedy roll-out.
    pub const GREEDY: Self = Self {
        greedy: 1,
        beam: 0,
        samples: 0,
        temperature: 0.0,
        look_ahead: 0,
        orders: 0,
        orders_grow: false,
    };

    /// What `auto` begins with: one roll-out, three actions at a time, for the search that follows makes more of the
    /// time than others would.
    pub const SHARE: Self = Self { greedy: 3, orders: 16, ..Self::GREEDY };

    /// What the solver `dqn` does: at most 32 complete roll-outs. Where demands have to be met by their
    /// deadlines, the order is most of what is left to win, and another one costs little.
    pub const fn whole(problem: Problem) -> Self {
        let (orders, orders_grow) = match problem {
            Problem::KCoverage => (96, true),
            Problem::Reward | Problem::Mobile => (16, false),
        };
        Self { beam: 15, samples: 16, temperature: 0.1, orders, orders_grow, ..Self::GREEDY }
    }
}

/// Stops that are put in again, over all orders of a tour, if their number grows with it: those of 32 stops in 32^2
/// orders.
const INSERTIONS: usize = 32 * 32 * 32;

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
        if effort.greedy > 0 {
            let mut ends = vec![self.begin()];
            self.greedy(&mut ends, effort.greedy)?;
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
            let stops = end.order();
            let grown = stops.len().pow(2).min(INSERTIONS / stops.len().max(1));
            let orders = if effort.orders_grow { effort.orders.max(grown) } else { effort.orders };
            reinsert(self.instance, self.definition, stops, orders, rng, kept);
        }
    }
}
