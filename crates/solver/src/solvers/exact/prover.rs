//! A proof under way: rounds of bounds, closed arcs and searches.

use rand_pcg::Pcg64Mcg;

use super::effort::{Effort, long_search};
use super::incumbent::Incumbent;
use super::knapsack::{self, apart_m};
use super::layers::{few, layers, resource};
use super::memory::Memory;
use super::model::{Aim, Model};
use super::multipliers::{Ascent, Multipliers};
use super::network::Network;
use super::prove::{Proof, improve, quickly};
use super::quick::{Care, quick};
use super::relaxation::{Reading, Relaxation, Resource};
use super::search::{End, Search};
use crate::solvers::Budget;

/// Steps of the ascent in the first round, the same where the proof may be short, and in later ones.
const FIRST_STEPS: u32 = 30;
const FIRST_STEPS_OF_SHORT: u32 = 14;
const STEPS: u32 = 15;
/// So many more in the first round of few, if as many gained this share of what is open.
const MORE_STEPS: u32 = 8;
const WORTH_MORE: f64 = 0.15;
/// Labels of the first search; each next one may make three times as many, within what memory allows.
const FIRST_LABELS: usize = 12_000;
const MOST_LABEL_BYTES: usize = 600 << 20;
/// The baseline does one iteration for so many labels; where sensors move, an iteration takes long.
const LABELS_PER_ITERATION: usize = 36;
/// In a share, where the proof turns out to be long, time is better spent on the tour first: for so many at most.
const MOST_ITERATIONS_OF_LONG_PROOF: u64 = 100_000;
const LABELS_PER_MOVING_ITERATION: usize = 500;
const MOST_ITERATIONS: u64 = 20_000;
/// Where the first bound leaves this share of the incumbent open, some iterations come before the search: few
/// labels are worth following under a better incumbent.
const WIDE_GAP: f64 = 0.15;
const ITERATIONS_OF_WIDE_GAP: u64 = 300;
const ITERATIONS_OF_WIDE_GAP_IN_SHARE: u64 = 2_000;
/// Where the first search leaves this share open, one more will hardly do.
const LONG_GAP: f64 = 0.1;
/// Where the first bound leaves this share open, not even the first search will: what a share does for the tour after
/// it then comes before it.
const HARD_GAP: f64 = 0.2;
/// Neighbours that every candidate remembers from the beginning; where the proof may be short, paths that
/// remember more cost less than a second round.
const FIRST_MEMORY: usize = 2;
const FIRST_MEMORY_OF_SHORT: usize = 4;
/// Before that they remember fewer, for a few steps of the ascent.
const NARROWING_MEMORY: usize = 1;
const NARROWING_STEPS: u32 = 3;
/// Steps of a round after which arcs are closed.
const EARLY: u32 = 3;
/// Partial tours of each length that are followed, before a search, to find a better tour soon; and already then where
/// energy is scarce: there bounds point to good tours early.
const DIVE: usize = 30;
const FIRST_DIVE_OF_ENERGY: usize = 10;
/// Where energy layers the paths, what narrowing leaves open tells how long the proof may take: with so many ways, a
/// share looks for a better tour first.
const WAYS_OF_LONG_PROOF: usize = 42_000;
const ITERATIONS_OF_MANY_WAYS: u64 = 7_000;
/// Beyond this many candidates a bound without paths is taken first.
const SMALL: usize = 128;

/// A proof under way.
pub struct Prover<'p, 'a, 'b> {
    pub model: &'p Model<'a>,
    pub network: &'p Network,
    pub paths: Relaxation<'p>,
    pub effort: Effort,
    pub incumbent: &'p mut Incumbent,
    pub rng: &'p mut Pcg64Mcg,
    pub budget: &'p mut Budget<'b>,
}

impl<'p> Prover<'p, '_, '_> {
    /// The paths that a proof begins with, which remember little; none if the budget ends before.
    pub fn paths(
        model: &'p Model<'_>,
        network: &'p Network,
        incumbent: &Incumbent,
        budget: &mut Budget<'_>,
    ) -> Option<Relaxation<'p>> {
        let resource = resource(model);
        let (intervals, horizon) = layers(model, network, incumbent, resource);
        let memory = nearest(model, network, NARROWING_MEMORY);
        Relaxation::new(model, network, resource, intervals, horizon, memory, budget)
    }

    /// Proves on from a bound that is known.
    pub fn prove<const W: usize>(mut self, rounds: u32, known: f64) -> Proof {
        let mut bound = known;
        if self.model.len() > SMALL {
            bound = quick(self.model, self.incumbent.cost, Care::Whole).max(known);
            if bound >= self.incumbent.cutoff() {
                return self.closed();
            }
        }
        let mut ascent = self.begin();
        match self.narrow(&mut ascent) {
            End::Closed => return self.closed(),
            End::Open(least) => bound = bound.max(least),
        }
        if self.budget.is_spent() {
            return self.left_open(bound);
        }
        let mut labels = FIRST_LABELS;
        for round in 0..rounds {
            match self.round::<W>(&mut ascent, round, labels) {
                End::Closed => return self.closed(),
                End::Open(least) => bound = bound.max(least),
            }
            if self.budget.is_spent() || round + 1 == rounds {
                break;
            }
            labels = (3 * labels).min(most_labels::<W>());
            let is_long = round > 0 || self.is_open(bound, LONG_GAP);
            if round > 0 || !self.incumbent.searched {
                self.improve(self.iterations(labels, is_long));
            }
            if self.incumbent.suffices() {
                return self.closed();
            }
            if self.budget.is_spent() {
                break;
            }
            let most = self.first_memory().max(FIRST_MEMORY + 1) + round as usize / 2;
            if !self.refine(&mut ascent, most) {
                break;
            }
        }
        self.left_open(bound)
    }

    /// Closes most arcs under bounds that cost little, of paths that remember little.
    fn narrow(&mut self, ascent: &mut Ascent) -> End {
        let target = target(self.model, self.incumbent, ascent);
        for _ in 0..NARROWING_STEPS {
            let spent = !self.budget.spend();
            if spent || ascent.climb(self.model, &mut self.paths, target, self.budget) {
                break;
            }
        }
        let bound = ascent.best.bound;
        if bound >= self.incumbent.cutoff() {
            return End::Closed;
        }
        self.paths.read(Reading::Tours);
        if !self.fix(&ascent.best) {
            return End::Open(bound);
        }
        self.paths.close_to_paths();
        let is_long = self.is_layered_by_energy() && self.paths.ways() > WAYS_OF_LONG_PROOF;
        if is_long && self.effort == Effort::Share {
            self.improve(ITERATIONS_OF_MANY_WAYS);
            if self.incumbent.suffices() {
                return End::Closed;
            }
        }
        let memory = nearest(self.model, self.network, self.first_memory());
        let tally = self.paths.tally().clone();
        self.paths.refine(memory, tally);
        End::Open(bound)
    }

    /// Whether one round may be the proof: candidates are few, or energy has its price.
    fn is_short(&self) -> bool {
        few(self.model) || self.is_layered_by_energy()
    }

    fn is_layered_by_energy(&self) -> bool {
        self.paths.resource() == Resource::Energy
    }

    /// Neighbours that each candidate remembers in the first round.
    fn first_memory(&self) -> usize {
        if self.is_short() { FIRST_MEMORY_OF_SHORT } else { FIRST_MEMORY }
    }

    /// Raises the bound, closes arcs, searches.
    fn round<const W: usize>(&mut self, ascent: &mut Ascent, round: u32, labels: usize) -> End {
        self.paths.read(Reading::Paths);
        ascent.restart();
        ascent.best.bound = f64::NEG_INFINITY;
        let model = self.model;
        let target = target(model, self.incumbent, ascent);
        let steps = match round {
            0 if self.is_short() => FIRST_STEPS_OF_SHORT,
            0 => FIRST_STEPS,
            _ => STEPS,
        };
        let more = if round == 0 && few(model) { MORE_STEPS } else { 0 };
        let mut known = f64::NEG_INFINITY;
        for step in 0..steps + more {
            let open = self.incumbent.cutoff() - ascent.best.bound;
            let gains_little = ascent.best.bound - known < WORTH_MORE * open;
            if step == steps && gains_little || !self.budget.spend() {
                break;
            }
            if step + MORE_STEPS == steps {
                known = ascent.best.bound;
            }
            // What is closed early makes every further step cheaper.
            if step == EARLY {
                if !self.fix(&ascent.best) {
                    break;
                }
                if self.is_layered_by_energy() && self.dive::<W>(ascent, FIRST_DIVE_OF_ENERGY) {
                    return End::Closed;
                }
            }
            let done = ascent.climb(model, &mut self.paths, target, self.budget);
            if ascent.best.bound >= self.incumbent.cutoff() {
                return End::Closed;
            }
            if done {
                break;
            }
        }
        if self.budget.is_spent() {
            return End::Open(ascent.best.bound);
        }
        let is_wide = self.is_open(ascent.best.bound, WIDE_GAP);
        if round == 0 && few(model) && is_wide && !self.incumbent.searched {
            let is_hard = self.is_open(ascent.best.bound, HARD_GAP);
            self.improve(match self.effort {
                Effort::Whole => ITERATIONS_OF_WIDE_GAP,
                Effort::Share if is_hard => self.iterations(labels, true),
                Effort::Share => ITERATIONS_OF_WIDE_GAP_IN_SHARE,
            });
            self.incumbent.searched = self.effort == Effort::Share && is_hard;
            if self.incumbent.suffices() {
                return End::Closed;
            }
        }
        self.paths.read(Reading::Tours);
        if !self.fix(&ascent.best) {
            return End::Open(ascent.best.bound);
        }
        if self.dive::<W>(ascent, DIVE) {
            return End::Closed;
        }
        self.search::<W>(ascent, labels)
    }

    /// Whether the budget lasted.
    #[must_use]
    pub(super) fn fix(&mut self, multipliers: &Multipliers) -> bool {
        let most = self.incumbent.cutoff() - multipliers.constant + multipliers.rounding;
        self.paths.evaluate(&multipliers.prices, self.budget).is_some()
            && self.paths.fix(&multipliers.prices, most, self.budget)
    }

    fn search<const W: usize>(&mut self, ascent: &Ascent, labels: usize) -> End {
        Search::<W>::new(self.model, &self.paths, &ascent.best, self.incumbent).run(
            labels,
            most_labels::<W>(),
            self.budget,
        )
    }

    /// Looks for a better tour where the bounds point; whether that is all that was asked for.
    #[must_use]
    fn dive<const W: usize>(&mut self, ascent: &Ascent, width: usize) -> bool {
        Search::<W>::new(self.model, &self.paths, &ascent.best, self.incumbent)
            .dive(width, self.budget);
        self.incumbent.suffices()
    }

    fn begin(&self) -> Ascent {
        let model = self.model;
        let mut ascent = Ascent::new(model, self.is_layered_by_energy());
        if let Some(order) =
            self.incumbent.order.as_ref().filter(|_| model.length_counts && !model.wide.moving)
        {
            ascent.begin(model, order);
        }
        if !model.length_counts {
            let (takes, limit) = knapsack::takes(model, self.paths.resource());
            if limit.is_finite() {
                ascent.begin_knapsack(model, &takes, limit);
            }
        }
        ascent
    }

    /// Whether a bound leaves more than this share of the incumbent open.
    fn is_open(&self, bound: f64, share: f64) -> bool {
        let cutoff = self.incumbent.cutoff();
        cutoff - bound > share * cutoff
    }

    /// Iterations of the baseline in proportion to the labels of the next search, or to what the tour may need.
    fn iterations(&self, labels: usize, is_long: bool) -> u64 {
        if self.model.wide.moving {
            return (labels / LABELS_PER_MOVING_ITERATION) as u64;
        }
        let stops = self.incumbent.order.as_ref().map_or(0, Vec::len) as u64;
        match self.effort {
            Effort::Share if is_long => long_search(stops, MOST_ITERATIONS_OF_LONG_PROOF),
            _ => ((labels / LABELS_PER_ITERATION) as u64).min(MOST_ITERATIONS),
        }
    }

    /// Lets the baseline improve the incumbent.
    fn improve(&mut self, iterations: u64) {
        improve(self.model, iterations, self.incumbent, self.rng, self.budget);
    }

    fn closed(&self) -> Proof {
        let bound = self.incumbent.cost.min(self.incumbent.beyond);
        Proof { order: self.incumbent.order.clone(), bound, closed: true }
    }

    fn left_open(&self, bound: f64) -> Proof {
        if self.budget.is_spent() && self.model.len() <= SMALL {
            // What a search that had no time at all would say still holds; beyond that size it is known already.
            return quickly(self.model, self.incumbent, bound, Care::Little);
        }
        let bound = bound.min(self.incumbent.cost).min(self.incumbent.beyond);
        Proof { order: self.incumbent.order.clone(), bound, closed: false }
    }
}

/// Labels for which there is memory.
fn most_labels<const W: usize>() -> usize {
    MOST_LABEL_BYTES / Search::<W>::LABEL_BYTES
}

fn target(model: &Model<'_>, incumbent: &Incumbent, ascent: &Ascent) -> f64 {
    if incumbent.cost.is_finite() {
        incumbent.cost
    } else if model.aim == Aim::AnyTour {
        1.0
    } else {
        let bound = ascent.best.bound;
        if bound.is_finite() { bound.abs() * 1.2 + 1.0 } else { 1.0 }
    }
}

/// Each candidate remembers so many of those near it.
fn nearest(model: &Model<'_>, network: &Network, size: usize) -> Memory {
    Memory::nearest(network, |a, b| apart_m(model, a, b), size)
}
