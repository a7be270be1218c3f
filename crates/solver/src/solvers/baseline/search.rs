//! The loop: ruin, recreate, accept.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::cost::Cost;
use super::recreate::recreate;
use super::ruin::ruin;
use crate::instance::{Effort, Instance};
use crate::local_search::{Neighbours, descend, squeeze};
use crate::scenario::Objective;
use crate::solvers::entry::{Claim, Found};
use crate::solvers::partial::{Partial, gain};
use crate::solvers::{Budget, SolverName, enumerate, greedy, shortcut};
use crate::tour::Value;

/// Temperature at the beginning and the end of an annealing run, in scales of the cost.
///
/// Which stops a tour has is decided while it is warm: distances below a twentieth of a scale seldom tell two
/// sets of stops apart, and iterations colder than that only mend the order of one of them.
const HEAT_OF_DISTANCE: (f64, f64) = (1.5, 0.05);
const HEAT_OF_GAIN: (f64, f64) = (10.0, 0.2);
/// Tours with more stops are annealed from a lower temperature, in proportion, and where distance is the cost to
/// a lower one: an iteration changes a smaller share of them.
const MANY_STOPS: f64 = 60.0;
/// Iterations of the first annealing run: so many a stop, within bounds.
const RUN_PER_STOP: u64 = 50;
const FIRST_RUN: u64 = 1000;
const LONGEST_FIRST_RUN: u64 = 4000;
/// Annealing runs without a feasible tour after which the best effort is looked for instead.
const PATIENT_RUNS: u32 = 5;
/// Pools beyond this size are cut down to what left and so many neighbours of each, where distance is the cost and
/// where gains are: those are many candidates for few places, and most iterations need not look at all of them.
const WIDE_POOL_OF_DISTANCE: (usize, usize) = (100, 6);
const WIDE_POOL_OF_GAIN: (usize, usize) = (40, 10);
/// But as often as this they are not.
const WHOLE_POOL: f64 = 0.02;
/// Tours longer than this are improved by local search in every iteration.
const LONG: usize = 40;
/// By at most so many moves; where sensors move, each takes as long as the tour.
const MOVES: usize = 100;
const MOVES_OF_MOVING: usize = 10;
/// A demand that no legal insertion meets has its deadlines repaired this often.
const REPAIR: f64 = 0.05;

/// The best tour found until the budget ends or the search stagnates. `start` is a legal tour to
/// begin with; it may be empty.
pub fn solve(
    instance: &Instance<'_>,
    start: &[u32],
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Found {
    let found = |order, iterations| Found {
        order,
        solver: SolverName::Baseline,
        iterations,
        claim: Claim::None,
    };
    let before = budget.iterations();
    if instance.len() <= enumerate::MOST {
        let order = enumerate::enumerate(instance, budget);
        let order = order.unwrap_or_else(|| shortcut::legal_start(instance));
        return found(order, vec![("enumeration".to_owned(), budget.iterations() - before)]);
    }
    search(instance, start, None, rng, budget)
}

/// [`solve`] from nothing, for when others have had the budget: even if it is spent, the construction is finished, for
/// a tour cut short would leave out what a moment more can serve; of a small instance, the enumeration.
pub fn finish(instance: &Instance<'_>, rng: &mut Pcg64Mcg, budget: &mut Budget<'_>) -> Found {
    let small = instance.len() <= enumerate::MOST;
    let least = if small { u64::MAX } else { construction(instance) };
    budget.part(least, u64::MAX, |part| solve(instance, &[], rng, part))
}

/// As many iterations as a construction may take.
pub(in crate::solvers) fn construction(instance: &Instance<'_>) -> u64 {
    2 * instance.len() as u64
}

/// [`solve`] without the enumeration of small instances. Where it is known how many iterations there will be, the
/// annealing runs are fitted to them, so that the last one is not cut off while it is warm.
pub(in crate::solvers) fn search(
    instance: &Instance<'_>,
    start: &[u32],
    iterations: Option<u64>,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Found {
    let before = budget.iterations();
    let mut first = start.to_vec();
    if first.is_empty() {
        first = greedy::greedy(instance, budget);
    }
    let built = budget.iterations();
    let mut search = Search::new(instance, Partial::new(instance, &first), rng);
    search.run(budget, iterations, PATIENT_RUNS);
    let mut order = search.best.tour.order().to_vec();
    if !search.best_value.is_feasible() && !budget.is_spent() {
        // Where not every demand can be met, it matters how many covering sets stand behind each.
        let mut complete = instance.clone();
        complete.demands = instance.all_demands.clone();
        let mut search = Search::new(&complete, Partial::new(&complete, &order), rng);
        search.run(budget, None, u32::MAX);
        order = search.best.tour.order().to_vec();
    }
    let ruined = budget.iterations() - built;
    let phases = [("construction", built - before), ("ruin and recreate", ruined)];
    let iterations = phases.into_iter().map(|(phase, count)| (phase.to_owned(), count)).collect();
    Found { order, solver: SolverName::Baseline, iterations, claim: Claim::None }
}

/// The length of the first of as many whole runs as there is room for, each twice as long as the one before, if the
/// first takes at least `length`; of the only one where there is not even room for that.
pub(super) fn fitted(length: u64, iterations: u64) -> u64 {
    let runs = (iterations / length.max(1) + 1).ilog2().max(1);
    iterations.div_ceil((1 << runs) - 1).max(1)
}

/// As many iterations as whole runs have that begin with a tour of so many stops: the nearest number of runs; where
/// that is none, the iterations.
pub(in crate::solvers) fn whole_runs(stops: u64, iterations: u64) -> u64 {
    let length = first_run(stops);
    let runs = (iterations as f64 / length as f64 + 1.0).log2().round() as u32;
    if runs == 0 { iterations } else { length * ((1 << runs.min(32)) - 1) }
}

/// Iterations of the first run.
pub(super) fn first_run(stops: u64) -> u64 {
    RUN_PER_STOP.saturating_mul(stops).clamp(FIRST_RUN, LONGEST_FIRST_RUN)
}

struct Search<'a, 'b> {
    /// Its own, for it changes what counts as effort.
    instance: Instance<'b>,
    scarce: Effort,
    tie: Effort,
    rng: &'a mut Pcg64Mcg,
    near: Neighbours,
    cost: Cost,
    /// Candidates that can be worth something.
    useful: Vec<u32>,
    best: Partial,
    best_value: Value,
}

impl<'a, 'b> Search<'a, 'b> {
    fn new(instance: &Instance<'b>, first: Partial, rng: &'a mut Pcg64Mcg) -> Self {
        let in_demand = |c: u32| !instance.demands.of[c as usize].is_empty();
        let all = 0..instance.len() as u32;
        Self {
            near: Neighbours::new(instance),
            cost: Cost::new(instance, &first),
            useful: all
                .filter(|&c| !instance.metric || in_demand(c) || gain(instance, c) > 0.0)
                .collect(),
            best_value: Value::of(instance, &first.tour),
            best: first,
            instance: instance.clone(),
            scarce: instance.effort,
            tie: instance.tie_effort(),
            rng,
        }
    }

    /// Anneals until the budget ends, nothing improves any more, or `runs` runs gave no feasible tour.
    fn run(&mut self, budget: &mut Budget<'_>, iterations: Option<u64>, runs: u32) {
        if self.useful.is_empty() || budget.is_spent() {
            return;
        }
        let stops = self.best.tour.len();
        let few = (MANY_STOPS / stops.max(1) as f64).min(1.0);
        let (hot, cold) = match self.instance.scenario.objective {
            Objective::MinDistance => (HEAT_OF_DISTANCE.0 * few, HEAT_OF_DISTANCE.1 * few),
            Objective::MaxReward | Objective::MaxCount => (HEAT_OF_GAIN.0 * few, HEAT_OF_GAIN.1),
        };
        let mut length = first_run(stops as u64);
        if let Some(iterations) = iterations {
            length = fitted(length, iterations);
        }
        let mut improved = budget.iterations();
        for run in 1.. {
            // Every third run spends what breaks ties sparingly, rather than what is scarce.
            self.instance.effort = if run % 3 == 2 { self.tie } else { self.scarce };
            self.cost.price(&self.instance, &self.best.tour);
            // Every third begins anew: where deadlines are tight, no way may lead from the best tour to a better.
            let mut current = if run > 1 && run % 3 == 1 && stops <= LONG {
                Partial::new(&self.instance, &[])
            } else {
                self.best.clone()
            };
            let mut trial = current.clone();
            let mut current_cost = self.cost.of(&self.instance, &current);
            let cools = (cold / hot).powf(1.0 / length as f64);
            let mut heat = self.cost.scale * hot;
            for i in 0..length {
                trial.clone_from(&current);
                self.change(&mut trial);
                let trial_cost = self.cost.of(&self.instance, &trial);
                let luck = -heat * self.rng.random_range(1e-12..1.0_f64).ln();
                heat *= cools;
                if trial.tour.is_legal() && trial_cost < current_cost + luck {
                    std::mem::swap(&mut current, &mut trial);
                    current_cost = trial_cost;
                    if self.keep(&current) {
                        improved = budget.iterations();
                    }
                }
                if current.missing() > 0 || i % 64 == 0 {
                    self.cost.adapt(&current);
                    current_cost = self.cost.of(&self.instance, &current);
                }
                if !budget.spend() {
                    return;
                }
            }
            let stuck = run >= runs && !self.best_value.is_feasible();
            if stuck || budget.iterations() - improved > self.patience() {
                return;
            }
            length *= 2;
        }
    }

    /// Iterations without improvement after which the search ends.
    fn patience(&self) -> u64 {
        let stops = self.best.tour.len() as u64 + 1;
        15 * stops * stops * stops + 20 * self.useful.len() as u64
    }

    fn change(&mut self, trial: &mut Partial) {
        let mut leaves = vec![false; self.instance.len()];
        let removed = ruin(&self.instance, &trial.tour, &mut self.near, self.rng, &mut leaves);
        trial.remove(&self.instance, |c| leaves[c as usize]);
        let mut pool = self.pool(&removed);
        recreate(&self.instance, trial, &mut pool, &self.cost, &mut self.near, self.rng);
        if !self.instance.untimed && trial.missing() > 0 && self.rng.random_bool(REPAIR) {
            self.repair(trial);
        }
        if self.instance.scenario.objective == Objective::MinDistance {
            self.prune(trial);
        }
        if trial.tour.len() > LONG {
            let mut dirty = removed;
            dirty.extend(pool);
            dirty.retain(|&c| trial.tour.serves(c));
            let moves = if self.instance.moving { MOVES_OF_MOVING } else { MOVES };
            descend(&self.instance, &mut trial.tour, &mut self.near, &mut dirty, moves);
        }
    }

    /// Brings in, by repair of the deadlines, one of those that open demands ask for the most.
    fn repair(&mut self, trial: &mut Partial) {
        let (instance, weight) = (&self.instance, &self.cost.weight);
        let mut asked: Option<(f64, u32)> = None;
        for &candidate in self.useful.iter().filter(|&&c| !trial.tour.serves(c)) {
            let relief = trial.relief(instance, candidate, weight);
            let drawn = relief * self.rng.random_range(0.5..1.0);
            if relief > 0.0 && asked.is_none_or(|(most, _)| drawn > most) {
                asked = Some((drawn, candidate));
            }
        }
        let Some((_, newcomer)) = asked else { return };
        if let Some(order) = squeeze(instance, trial.tour.order(), newcomer) {
            let repaired = Partial::new(instance, &order);
            // The order keeps all times; the energy that it takes may still be too much.
            if repaired.tour.is_legal() {
                *trial = repaired;
            }
        }
    }

    fn pool(&mut self, removed: &[u32]) -> Vec<u32> {
        let (wide, near) = match self.instance.scenario.objective {
            Objective::MinDistance => WIDE_POOL_OF_DISTANCE,
            Objective::MaxReward | Objective::MaxCount => WIDE_POOL_OF_GAIN,
        };
        if self.useful.len() <= wide || self.rng.random_bool(WHOLE_POOL) {
            return self.useful.clone();
        }
        let mut pool = removed.to_vec();
        for &candidate in removed {
            pool.extend(self.near.of(&self.instance, candidate).iter().take(near));
        }
        pool.sort_unstable();
        pool.dedup();
        pool
    }

    /// Takes out stops that no demand needs, in random order.
    fn prune(&mut self, trial: &mut Partial) {
        let instance = &self.instance;
        let stops = trial.tour.len();
        let offset = if stops == 0 { 0 } else { self.rng.random_range(0..stops) };
        if instance.metric {
            trial.remove_spare(instance, offset);
            return;
        }
        let order: Vec<u32> = trial.tour.order().to_vec();
        for i in 0..stops {
            let candidate = order[(i + offset) % stops];
            if trial.is_needed(instance, candidate) {
                continue;
            }
            let length = trial.tour.finished().distance_m;
            let position = trial.tour.position(candidate);
            trial.remove(instance, |c| c == candidate);
            let worse = trial.tour.finished().distance_m > length || !trial.tour.is_legal();
            if let Some(position) = position.filter(|_| worse) {
                trial.insert(instance, position, candidate);
            }
        }
    }

    /// Keeps a tour that is better than the best.
    fn keep(&mut self, current: &Partial) -> bool {
        let missing = if current.missing() == 0 {
            (0, 0)
        } else if self.best_value.is_feasible() {
            return false;
        } else {
            self.instance.all_demands.missing(|c| current.tour.serves(c))
        };
        let value = Value::with_missing(&self.instance, &current.tour, missing);
        let better = value.beats(&self.best_value);
        if better {
            self.best_value = value;
            self.best.clone_from(current);
        }
        better
    }
}
