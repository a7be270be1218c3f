//! Ant Colony System (paper, section "Comparison Algorithms" of the optimal k-coverage charging problem; M.
//! Dorigo, L. Gambardella, "Ant colony system", 1997; C.-B. Cheng, C.-P. Mao, "A modified ant colony system
//! for solving the travelling salesman problem with time windows", 2007).
//!
//! Deviations, where the paper is silent or leaves a choice:
//! 1. An ant goes only to sensors that lower an entry of the table T, as the paper's dynamic programme does.
//! 2. The pheromone of all edges decays by equation (tau_ij) only in an iteration that has a feasible tour.
//! 3. The slack and the wait of the two deadline heuristics are measured in their means over the open
//!    sensors, so that their steepness has no unit.
//! 4. The nearness of a sensor counts beside the two, as in the colony system that they were added to.
//! 5. A tour that is not feasible is kept where there is no better one: the plan says what it breaks.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Budget;
use super::greedy;
use super::paper::{Attempt, PaperOptions, Unfinished};
use crate::instance::Instance;
use crate::tour::{Run, Tour, Value};

/// Parameters of the colony. The paper names none; these are those of Dorigo and Gambardella, but for `q0`: with
/// their 0.9 more scenarios are left without a feasible tour (32 sensors, k 2, alpha 0.8: 9 of 12 have one, and
/// 11 with 0.5).
#[derive(Clone, Debug, PartialEq)]
pub struct AcsOptions {
    /// Colonies, one after the other, each without pheromone; the best tour of all is kept.
    pub runs: u32,
    /// Iterations of a colony at most.
    pub iterations: u32,
    /// Iterations without a better tour after which a colony ends.
    pub patience: u32,
    /// Ants in an iteration.
    pub ants: u32,
    /// Exponent of the nearness.
    pub beta: f64,
    /// Share of the steps that take the best edge rather than a random one.
    pub q0: f64,
    /// Global pheromone decay (theta).
    pub decay: f64,
    /// Local pheromone decay.
    pub local_decay: f64,
    /// Steepness of the first deadline heuristic: little slack is attractive.
    pub slack: f64,
    /// Steepness of the second: a long wait is not.
    pub wait: f64,
}

impl Default for AcsOptions {
    fn default() -> Self {
        Self {
            runs: 5,
            iterations: 1_000,
            patience: 200,
            ants: 10,
            beta: 2.0,
            q0: 0.5,
            decay: 0.1,
            local_decay: 0.1,
            slack: 1.0,
            wait: 1.0,
        }
    }
}

/// The shortest feasible tour of all ants.
pub(super) fn acs(
    instance: &Instance<'_>,
    options: &PaperOptions,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Attempt {
    let places = instance.len() + 2;
    if places.saturating_mul(places).saturating_mul(size_of::<f64>()) > options.memory_bytes {
        return Attempt::ended_by(Unfinished::Memory);
    }
    let mut best = (Vec::new(), Value::of(instance, &Tour::new(instance, &[])));
    for _ in 0..options.acs.runs {
        if !colony(instance, &options.acs, &mut best, rng, budget) {
            return Attempt { order: best.0, unfinished: Some(Unfinished::Budget) };
        }
    }
    Attempt::finished(best.0)
}

/// Iterations of one colony, which may find a better tour; whether it came to its end.
fn colony(
    instance: &Instance<'_>,
    options: &AcsOptions,
    best: &mut (Vec<u32>, Value),
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> bool {
    let mut trail = Trail::new(instance);
    let mut idle = 0;
    for _ in 0..options.iterations {
        let mut shortest: Option<(Vec<u32>, Value)> = None;
        for _ in 0..options.ants {
            if budget.is_spent() {
                return false;
            }
            let order = Ant::new(instance).walk(options, &trail, rng);
            trail.evaporate(&order, options.local_decay);
            let tour = Tour::new(instance, &order);
            let value = Value::of(instance, &tour);
            if tour.is_legal() && value.beats(&best.1) {
                *best = (order.clone(), value);
                idle = 0;
            }
            if tour.is_legal() && shortest.as_ref().is_none_or(|old| value.beats(&old.1)) {
                shortest = Some((order, value));
            }
            budget.spend();
        }
        if let Some((order, value)) = shortest.filter(|(_, value)| value.is_feasible()) {
            trail.reinforce(&order, value.cost, options.decay);
        }
        idle += 1;
        if idle > options.patience {
            break;
        }
    }
    true
}

/// The pheromone of every edge, row to column; start and end are the two places behind the candidates.
struct Trail {
    size: usize,
    initial: f64,
    amount: Vec<f64>,
}

impl Trail {
    /// 1 / (n L) on each edge, L being the length of the tour that always goes to the nearest.
    fn new(instance: &Instance<'_>) -> Self {
        let size = instance.len() + 2;
        let order = greedy::nearest(instance, false, &mut Budget::new(&|_| false));
        let length_m = Tour::new(instance, &order).finished().distance_m;
        let initial = 1.0 / (size as f64 * length_m.max(1.0));
        Self { size, initial, amount: vec![initial; size * size] }
    }

    fn of(&self, from: usize, to: usize) -> f64 {
        self.amount[from * self.size + to]
    }

    /// The edges of a tour, as indices.
    fn edges(&self, order: &[u32]) -> Vec<usize> {
        let (start, end) = (self.size - 2, self.size - 1);
        let stops = || order.iter().map(|&stop| stop as usize);
        let from = std::iter::once(start).chain(stops());
        from.zip(stops().chain([end])).map(|(from, to)| from * self.size + to).collect()
    }

    /// The local update: towards the initial amount on the edges that an ant took.
    fn evaporate(&mut self, order: &[u32], decay: f64) {
        for edge in self.edges(order) {
            self.amount[edge] = (1.0 - decay) * self.amount[edge] + decay * self.initial;
        }
    }

    /// The global update (equations Deltatau_ij and tau_ij): all edges decay, those of the shortest tour gain.
    fn reinforce(&mut self, shortest: &[u32], length_m: f64, decay: f64) {
        self.amount.iter_mut().for_each(|amount| *amount *= 1.0 - decay);
        for edge in self.edges(shortest) {
            self.amount[edge] += decay / length_m.max(1.0);
        }
    }
}

/// An agent under way: where it is, and what the table T still asks.
struct Ant<'a, 'b> {
    instance: &'a Instance<'b>,
    here: Run,
    order: Vec<u32>,
    visited: Vec<bool>,
    lacks: Vec<u32>,
}

/// A sensor that an ant may go to.
struct Open {
    candidate: u32,
    leg_m: f64,
    slack_s: f64,
    wait_s: f64,
}

impl<'a, 'b> Ant<'a, 'b> {
    fn new(instance: &'a Instance<'b>) -> Self {
        Self {
            instance,
            here: instance.departure(),
            order: Vec::new(),
            visited: vec![false; instance.len()],
            lacks: instance.demands.demands.iter().map(|demand| demand.needs).collect(),
        }
    }

    /// Walks until the coverage is kept, or it is stuck.
    fn walk(mut self, options: &AcsOptions, trail: &Trail, rng: &mut Pcg64Mcg) -> Vec<u32> {
        loop {
            let open = self.open();
            let scores = scores(&open, options, trail, self.here.node as usize);
            let Some(next) = choose(&scores, options.q0, rng) else { return self.order };
            let candidate = open[next].candidate;
            self.here = self.instance.step(&self.here, candidate);
            self.order.push(candidate);
            self.visited[candidate as usize] = true;
            for &d in &self.instance.demands.of[candidate as usize] {
                self.lacks[d as usize] = self.lacks[d as usize].saturating_sub(1);
            }
        }
    }

    /// The sensors that help, are reached before their deadlines, and leave a way to the end.
    fn open(&self) -> Vec<Open> {
        let instance = self.instance;
        let helps =
            |c: u32| instance.demands.of[c as usize].iter().any(|&d| self.lacks[d as usize] > 0);
        let ahead = (0..instance.len() as u32).filter(|&c| !self.visited[c as usize] && helps(c));
        let open = ahead.filter_map(|candidate| {
            let there = instance.step(&self.here, candidate);
            let leg_m = there.distance_m - self.here.distance_m;
            let leg_s = leg_m / instance.scenario.charger.speed_mps;
            let legal = instance.in_time(&there) && instance.keeps_limits(&instance.finish(&there));
            legal.then(|| Open {
                candidate,
                leg_m,
                slack_s: instance.candidates[candidate as usize].due_s - there.arrive_s,
                wait_s: (there.arrive_s - self.here.depart_s - leg_s).max(0.0),
            })
        });
        open.collect()
    }
}

/// Pheromone x nearness^beta x the two deadline heuristics, by open sensor.
fn scores(open: &[Open], options: &AcsOptions, trail: &Trail, from: usize) -> Vec<f64> {
    let mean = |of: &dyn Fn(&Open) -> f64| {
        let finite: Vec<f64> = open.iter().map(of).filter(|value| value.is_finite()).collect();
        (finite.iter().sum::<f64>() / finite.len().max(1) as f64).max(1e-9)
    };
    let (mean_slack, mean_wait) = (mean(&|open| open.slack_s), mean(&|open| open.wait_s));
    let falling = |steepness: f64, value: f64, mean: f64| {
        // However unattractive, it stays possible.
        (1.0 / (1.0 + (steepness * (value - mean) / mean).exp())).max(1e-6)
    };
    let score = |open: &Open| {
        let urgency = falling(options.slack, open.slack_s, mean_slack);
        let patience =
            if open.wait_s > 0.0 { falling(options.wait, open.wait_s, mean_wait) } else { 1.0 };
        let nearness = (1.0 / open.leg_m.max(1e-3)).powf(options.beta);
        trail.of(from, open.candidate as usize) * nearness * urgency * patience
    };
    open.iter().map(score).collect()
}

/// The transition rule: the best with probability `q0`, else one at random in proportion to its score.
fn choose(scores: &[f64], q0: f64, rng: &mut Pcg64Mcg) -> Option<usize> {
    let best = (0..scores.len()).reduce(|a, b| if scores[b] > scores[a] { b } else { a })?;
    if rng.random_range(0.0..1.0) < q0 {
        return Some(best);
    }
    let total: f64 = scores.iter().sum();
    let mut left = rng.random_range(0.0..1.0) * total;
    let chosen = scores.iter().position(|score| {
        left -= score;
        left < 0.0
    });
    Some(chosen.unwrap_or(best))
}
