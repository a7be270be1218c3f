//! The proof: an incumbent, and rounds of better bounds and longer searches until one of them closes.

use rand_pcg::Pcg64Mcg;

use super::counting;
use super::effort::Effort;
use super::incumbent::Incumbent;
use super::layers::{INTERVALS, MOST_ARRIVALS};
use super::model::{Aim, Model};
use super::network::Network;
use super::prover::Prover;
use super::quick::{Care, quick};
use crate::scenario::Objective;
use crate::solvers::{Budget, baseline};

/// What a proof has come to.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The best tour known; none if no feasible one is.
    pub order: Option<Vec<u32>>,
    /// No feasible tour costs less; infinite if there is none.
    pub bound: f64,
    /// Whether the search has ended: the tour is the best, or there is none.
    pub closed: bool,
}

/// Rounds of a whole proof at most.
const ROUNDS: u32 = 20;
/// Rounds of a share, and up to how many arcs over all layers they are worth beginning.
const SHARES: [(u32, usize); 3] = [(4, 200_000), (2, 1_000_000), (1, 3_000_000)];
/// Up to how many where sensors move: there paths are followed within an interval over and over.
const MOST_MOVING_ARCS_OF_SHARE: usize = 500_000;
/// In a share where rewards count, so many before the first bound: a good tour of an easy field.
const ITERATIONS_OF_REWARDS: u64 = 300;

/// Proves on, from what is known, until closed or the budget is spent.
pub fn prove(
    model: &Model<'_>,
    effort: Effort,
    incumbent: &mut Incumbent,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Proof {
    let mut known = f64::NEG_INFINITY;
    if counting::applies(model, incumbent) {
        let counted = counting::count(model, effort, incumbent, budget);
        if counted.closed || budget.is_spent() {
            return counted;
        }
        known = counted.bound;
    }
    let words = model.len().max(model.demands.len()).div_ceil(64);
    if budget.is_spent() || words > 8 || model.len() * model.len() * INTERVALS > MOST_ARRIVALS {
        let care = if budget.is_spent() { Care::Little } else { Care::Whole };
        return quickly(model, incumbent, known, care);
    }
    let rewards = model.wide.scenario.objective == Objective::MaxReward && !model.wide.moving;
    if effort == Effort::Share && model.aim == Aim::Optimum && rewards {
        improve(model, ITERATIONS_OF_REWARDS, incumbent, rng, budget);
        if budget.is_spent() {
            return quickly(model, incumbent, known, Care::Little);
        }
    }
    let network = Network::new(model, incumbent.cutoff());
    let arrivals = network.arcs.len() * INTERVALS;
    let most = if model.wide.moving { MOST_MOVING_ARCS_OF_SHARE } else { usize::MAX };
    let share =
        SHARES.iter().find(|share| arrivals <= share.1.min(most)).map_or(0, |share| share.0);
    let rounds = if effort == Effort::Whole { ROUNDS } else { share };
    if rounds == 0 {
        return quickly(model, incumbent, known, Care::Whole);
    }
    let Some(paths) = Prover::paths(model, &network, incumbent, budget) else {
        return quickly(model, incumbent, known, Care::Little);
    };
    let prover = Prover { model, network: &network, paths, effort, incumbent, rng, budget };
    match words {
        0..=1 => prover.prove::<1>(rounds, known),
        2 => prover.prove::<2>(rounds, known),
        3..=4 => prover.prove::<4>(rounds, known),
        _ => prover.prove::<8>(rounds, known),
    }
}

/// What is known without relaxed paths.
pub(super) fn quickly(model: &Model<'_>, incumbent: &Incumbent, known: f64, care: Care) -> Proof {
    let bound = quick(model, incumbent.cost, care).max(known);
    let closed = bound == f64::INFINITY || bound >= incumbent.cutoff() && incumbent.order.is_some();
    let bound = bound.min(incumbent.cost).min(incumbent.beyond);
    Proof { order: incumbent.order.clone(), bound, closed }
}

/// Searches on from the incumbent.
pub(super) fn improve(
    model: &Model<'_>,
    iterations: u64,
    incumbent: &mut Incumbent,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) {
    let start = incumbent.order.clone().unwrap_or_default();
    let search =
        |part: &mut Budget<'_>| baseline::search(model.strict, &start, Some(iterations), rng, part);
    let found = budget.part(0, iterations, search);
    incumbent.offer(model, found.order);
}
