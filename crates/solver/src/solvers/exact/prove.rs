//! The proof: an incumbent, bounds of rising quality, and branches where one search does not close them.

use rand_pcg::Pcg64Mcg;

use super::incumbent::Incumbent;
use super::memory::{self, Memory};
use super::model::{Aim, Model};
use super::multipliers::Ascent;
use super::network::Network;
use super::relaxation::{Reading, Relaxation, Resource};
use super::search::{End, Search};
use super::tally::Tally;
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

/// Rounds at most; by then the labels of a search have long reached their limit.
const ROUNDS: u32 = 20;
/// Steps of the ascent in a round.
const STEPS: u32 = 15;
/// Labels of the first search; each next one may make twice as many, within what memory allows.
const FIRST_LABELS: usize = 2_000;
const MOST_LABEL_BYTES: usize = 600 << 20;
/// The baseline does one iteration for so many labels.
const LABELS_PER_ITERATION: usize = 2;
const MOST_ITERATIONS: u64 = 20_000;
/// Layers of time or energy, at first and at most.
const INTERVALS: usize = 96;
const MOST_INTERVALS: usize = 200;
/// Neighbours that every candidate remembers from the beginning.
const FIRST_MEMORY: usize = 2;
/// Combinations of counts that the states of paths may take.
const MOST_TALLY: usize = 128;
/// Values that the bounds may take up.
const MOST_VALUES: usize = 40_000_000;
/// Arcs over all layers for which paths are laid out at all.
const MOST_ARRIVALS: usize = 60_000_000;

/// Proves on, from what is known, until closed or the budget is spent.
pub fn prove(
    model: &Model<'_>,
    incumbent: &mut Incumbent,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Proof {
    let words = model.len().max(model.demands.len()).div_ceil(64);
    if words > 8 || model.len() * model.len() * INTERVALS > MOST_ARRIVALS {
        return Proof { order: incumbent.order.clone(), bound: f64::NEG_INFINITY, closed: false };
    }
    let network = Network::new(model);
    let prover = Prover::new(model, &network, incumbent, rng, budget);
    match words {
        0..=1 => prover.prove::<1>(),
        2 => prover.prove::<2>(),
        3..=4 => prover.prove::<4>(),
        _ => prover.prove::<8>(),
    }
}

struct Prover<'p, 'a, 'b> {
    model: &'p Model<'a>,
    paths: Relaxation<'p>,
    incumbent: &'p mut Incumbent,
    rng: &'p mut Pcg64Mcg,
    budget: &'p mut Budget<'b>,
}

impl<'p, 'a, 'b> Prover<'p, 'a, 'b> {
    fn new(
        model: &'p Model<'a>,
        network: &'p Network,
        incumbent: &'p mut Incumbent,
        rng: &'p mut Pcg64Mcg,
        budget: &'p mut Budget<'b>,
    ) -> Self {
        let resource = resource(model);
        let (intervals, horizon) = layers(model, network, incumbent, resource);
        let near = |a: usize, b: usize| apart_m(model, a, b);
        let memory = Memory::nearest(network, near, FIRST_MEMORY);
        let paths = Relaxation::new(model, network, resource, intervals, horizon, memory);
        Self { model, paths, incumbent, rng, budget }
    }

    fn prove<const W: usize>(mut self) -> Proof {
        let mut bound = f64::NEG_INFINITY;
        let mut ascent = self.begin();
        let most_labels = MOST_LABEL_BYTES / Search::<W>::LABEL_BYTES;
        let mut labels = FIRST_LABELS;
        for round in 0..ROUNDS {
            match self.round::<W>(&mut ascent, labels) {
                End::Closed => return self.closed(),
                End::Open(least) => bound = bound.max(least),
            }
            if self.budget.is_spent() {
                break;
            }
            labels = (2 * labels).min(most_labels);
            self.improve(((labels / LABELS_PER_ITERATION) as u64).min(MOST_ITERATIONS));
            if self.incumbent.suffices() {
                return self.closed();
            }
            self.refine(&mut ascent, FIRST_MEMORY + 1 + round as usize / 2);
        }
        self.left_open(bound)
    }

    /// Raises the bound, closes arcs, searches.
    fn round<const W: usize>(&mut self, ascent: &mut Ascent, labels: usize) -> End {
        self.paths.read(Reading::Paths);
        ascent.restart();
        ascent.best.bound = f64::NEG_INFINITY;
        let model = self.model;
        let target = target(model, self.incumbent, ascent);
        for _ in 0..STEPS {
            if !self.budget.spend() {
                break;
            }
            let done = ascent.climb(model, &mut self.paths, target);
            if ascent.best.bound >= self.incumbent.cutoff() {
                return End::Closed;
            }
            if done {
                break;
            }
        }
        let m = &ascent.best;
        let most = self.incumbent.cutoff() - m.constant + m.rounding();
        for reading in [Reading::Paths, Reading::Tours] {
            self.paths.read(reading);
            self.paths.evaluate(&m.prizes);
            self.paths.fix(&m.prizes, most);
        }
        self.search::<W>(ascent, labels)
    }

    fn search<const W: usize>(&mut self, ascent: &Ascent, labels: usize) -> End {
        Search::<W>::new(self.model, &self.paths, &ascent.best, self.incumbent)
            .run(labels, self.budget)
    }

    fn begin(&self) -> Ascent {
        let model = self.model;
        let mut ascent = Ascent::new(model);
        if let Some(order) =
            self.incumbent.order.as_ref().filter(|_| model.length_counts && !model.wide.moving)
        {
            ascent.begin(model, order);
        }
        ascent
    }

    /// Makes the paths more like tours: the candidates on each way round remember where it began, and
    /// the demand that paths keep to the least is counted.
    fn refine(&mut self, ascent: &mut Ascent, most: usize) {
        self.paths.read(Reading::Paths);
        self.paths.evaluate(&ascent.best.prizes);
        let path = self.paths.path(&ascent.best.prizes);
        let mut memory = self.paths.memory().clone();
        for (end, &stop) in path.iter().enumerate() {
            if let Some(begin) = path[..end].iter().rposition(|&other| other == stop) {
                memory.learn(stop, &path[begin + 1..end], most.min(memory::MOST));
            }
        }
        let mut tally = self.paths.tally().clone();
        if let Some(demand) = ascent.loosest(self.model) {
            let states = tally.states * (self.model.demands[demand].needs as usize + 1);
            if states <= MOST_TALLY && self.paths.size(&memory, states) <= MOST_VALUES {
                let mut demands = tally.demands.clone();
                demands.push(demand);
                tally = Tally::new(self.model, demands);
                ascent.count(self.model, demand);
            }
        }
        if self.paths.resource() == Resource::Time
            && self.paths.intervals() < MOST_INTERVALS
            && self.late(&path)
        {
            self.paths.split(self.model);
        }
        if self.paths.size(&memory, tally.states) < MOST_VALUES {
            self.paths.refine(memory, tally);
        } else {
            self.paths.refine(self.paths.memory().clone(), tally);
        }
    }

    /// Whether a relaxed path misses a deadline, which rounding of times hides.
    fn late(&self, path: &[u32]) -> bool {
        let instance = &self.model.wide;
        let mut run = instance.departure();
        path.iter().any(|&stop| {
            run = instance.step(&run, stop);
            !instance.in_time(&run)
        }) || instance.finish(&run).arrive_s > instance.timespan_s
    }

    /// Lets the baseline improve the incumbent for some iterations.
    fn improve(&mut self, iterations: u64) {
        let outer = std::cell::RefCell::new(&mut *self.budget);
        let stop = |done: u64| done >= iterations || done > 0 && !outer.borrow_mut().spend();
        let start = self.incumbent.order.clone().unwrap_or_default();
        let found = baseline::search(self.model.strict, &start, self.rng, &mut Budget::new(&stop));
        self.incumbent.offer_order(self.model, found.order);
    }

    fn closed(&self) -> Proof {
        let bound = self.incumbent.cost.min(self.incumbent.beyond);
        Proof { order: self.incumbent.order.clone(), bound, closed: true }
    }

    fn left_open(&self, bound: f64) -> Proof {
        let bound = bound.min(self.incumbent.cost).min(self.incumbent.beyond);
        Proof { order: self.incumbent.order.clone(), bound, closed: false }
    }
}

/// The resource whose limits bind the most.
fn resource(model: &Model<'_>) -> Resource {
    if model.energy_counts && !model.length_counts {
        Resource::Energy
    } else if model.time_counts {
        Resource::Time
    } else {
        Resource::Stops
    }
}

/// Number of intervals and where they end.
fn layers(
    model: &Model<'_>,
    network: &Network,
    incumbent: &Incumbent,
    resource: Resource,
) -> (usize, f64) {
    let instance = &model.wide;
    let charger = &instance.scenario.charger;
    match resource {
        Resource::Stops => (model.len().max(1), 0.0),
        Resource::Energy => (INTERVALS, instance.capacity_j.max(1e-9)),
        Resource::Time => {
            let reachable = (0..model.len()).filter(|&i| network.earliest_s[i].is_finite());
            let due = reachable.map(|i| instance.candidates[i].due_s).fold(0.0, f64::max);
            let mut horizon = due.min(instance.timespan_s);
            if model.length_counts && incumbent.cost.is_finite() {
                // No better tour is on its way for longer: it travels less, charges each once, and waits
                // at most until the last is ready.
                let charge_s = instance
                    .candidates
                    .iter()
                    .map(|c| c.charge_j(c.due_s.min(c.empty_s()).min(1e300)) / charger.transfer_w);
                let ready = instance.candidates.iter().map(|c| c.ready_s).fold(0.0, f64::max);
                let travel_s = incumbent.cost / charger.speed_mps;
                horizon = horizon.min(ready + charge_s.sum::<f64>() + travel_s);
            }
            if !horizon.is_finite() {
                // Nothing is scarce after the last deadline.
                let due = instance.candidates.iter().map(|c| c.due_s).filter(|due| due.is_finite());
                horizon = due.fold(1.0, f64::max);
            }
            let horizon = horizon.max(1e-9);
            // Where every arc leads into a later interval, no layer needs a second look.
            let fine = (horizon / network.least_step(model)).ceil();
            if fine <= 3.0 * INTERVALS as f64 {
                return ((fine as usize + 1).max(INTERVALS), horizon);
            }
            (INTERVALS, horizon)
        }
    }
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

/// Roughly how far two candidates are apart, in metres.
fn apart_m(model: &Model<'_>, a: usize, b: usize) -> f64 {
    if model.wide.moving {
        (model.wide.candidates[a].point - model.wide.candidates[b].point).norm()
    } else {
        model.wide.distance_m(a, b)
    }
}
