//! Lagrangian multipliers: demands and "at most once" move from the paths into prizes.

use super::Model;
use super::prices::Prices;
use super::relaxation::Relaxation;
use crate::solvers::Budget;

/// Share of the way to the target that the first step of an ascent takes, as the slope is.
const FIRST_STEP: f64 = 0.7;
/// Mean charges whose energy weighs as much as a visit: fewer, and the price of energy swings.
const CHARGES_PER_VISIT: f64 = 6.0;

/// Prizes that make relaxed paths serve what must be served, once each, and the bound that they prove.
#[derive(Clone, Debug)]
pub struct Multipliers {
    /// By demand, what one member more is worth; not negative.
    demand: Vec<f64>,
    /// By candidate, what a visit is charged; not negative.
    visit: Vec<f64>,
    /// What a joule is charged; not negative.
    energy: f64,
    /// What all the energy that the charger has is worth.
    limit: f64,
    /// What paths pay for all this.
    pub prices: Prices,
    /// What does not depend on the path.
    pub constant: f64,
    /// How far rounding may have moved the bound.
    pub rounding: f64,
    /// The bound on the cost of every feasible tour.
    pub bound: f64,
}

impl Multipliers {
    /// None: only the gains count.
    pub fn zero(model: &Model<'_>) -> Self {
        let mut zero = Self {
            demand: vec![0.0; model.demands.len()],
            visit: vec![0.0; model.len()],
            energy: 0.0,
            limit: 0.0,
            prices: Prices::default(),
            constant: 0.0,
            rounding: 0.0,
            bound: f64::NEG_INFINITY,
        };
        zero.price(model);
        zero
    }

    fn price(&mut self, model: &Model<'_>) {
        let of = |i: usize| model.of[i].iter().map(|&d| self.demand[d as usize]).sum::<f64>();
        let prize = |i: usize| model.gains[i] + of(i) - self.visit[i];
        self.prices = Prices { prizes: (0..model.len()).map(prize).collect(), per_j: self.energy };
        let needs = model.demands.iter().zip(&self.demand).map(|(d, m)| f64::from(d.needs) * m);
        self.limit = if self.energy > 0.0 { self.energy * model.wide.capacity_j } else { 0.0 };
        self.constant = needs.sum::<f64>() - self.visit.iter().sum::<f64>() - self.limit;
        let sum: f64 = self.demand.iter().chain(&self.visit).sum();
        self.rounding = 1e-12 * (1.0 + sum + self.limit + self.constant.abs());
    }
}

/// Ascent of the bound by subgradients, deflected by the direction before.
#[derive(Debug)]
pub struct Ascent {
    /// The best multipliers so far.
    pub best: Multipliers,
    at: Multipliers,
    /// Of the demands, the visits and the energy.
    direction: Vec<f64>,
    /// Joules that weigh as much as a visit; none if energy has no price.
    unit_j: Option<f64>,
    step: f64,
    stalled: u32,
    /// By demand, how far paths are from its needs on average, the later ones weighing more.
    misses: Vec<f64>,
    /// By demand, whether paths are made to meet it.
    counted: Vec<bool>,
}

impl Ascent {
    /// Without multipliers. Where energy layers the paths it has a price too, so that what they gain where their
    /// amounts are rounded down is paid for.
    pub fn new(model: &Model<'_>, layered_by_energy: bool) -> Self {
        let charges_j = model.wide.candidates.iter().map(|c| c.charge_j(0.0));
        let unit_j = CHARGES_PER_VISIT * charges_j.sum::<f64>() / model.len().max(1) as f64;
        let zero = Multipliers::zero(model);
        Self {
            best: zero.clone(),
            at: zero,
            direction: vec![0.0; model.demands.len() + model.len() + 1],
            unit_j: layered_by_energy.then_some(unit_j).filter(|unit_j| *unit_j > 0.0),
            step: FIRST_STEP,
            stalled: 0,
            misses: vec![0.0; model.demands.len()],
            counted: vec![false; model.demands.len()],
        }
    }

    /// Begins at multipliers under which the stops of a known tour are worth what they cost.
    pub fn begin(&mut self, model: &Model<'_>, order: &[u32]) {
        let instance = &model.wide;
        let places: Vec<usize> = std::iter::once(instance.start())
            .chain(order.iter().map(|&c| c as usize))
            .chain([instance.end()])
            .collect();
        let mut shares = vec![(0.0, 0.0); model.demands.len()];
        for leg in places.windows(3) {
            let half =
                0.5 * (instance.distance_m(leg[0], leg[1]) + instance.distance_m(leg[1], leg[2]));
            let of = &model.of[leg[1]];
            for &d in of {
                let (sum, count) = &mut shares[d as usize];
                *sum += half / of.len() as f64;
                *count += 1.0;
            }
        }
        for (multiplier, (sum, count)) in self.at.demand.iter_mut().zip(shares) {
            *multiplier = if count > 0.0 { sum / count } else { 0.0 };
        }
        self.at.price(model);
        self.best = self.at.clone();
    }

    /// Begins at the multipliers of a knapsack: a visit is charged what it is worth beyond the scarce resource
    /// that it takes, by the price at which the best candidates just fill the `limit`.
    pub fn begin_knapsack(&mut self, model: &Model<'_>, takes: &[f64], limit: f64) {
        let mut order: Vec<usize> = (0..model.len()).filter(|&i| takes[i].is_finite()).collect();
        let rate = |i: usize| model.gains[i] / takes[i].max(1e-9);
        order.sort_by(|&a, &b| rate(b).total_cmp(&rate(a)));
        let mut filled = 0.0;
        let last = order.iter().find(|&&i| {
            filled += takes[i];
            filled > limit
        });
        let Some(price) = last.map(|&i| rate(i)) else { return };
        for &i in &order {
            self.at.visit[i] = (model.gains[i] - price * takes[i]).max(0.0);
        }
        if self.unit_j.is_some() {
            self.at.energy = price;
        }
        self.at.price(model);
        self.best = self.at.clone();
    }

    /// The demand that the paths miss or overshoot the most, by its multiplier; not one that is counted.
    pub fn loosest(&self, model: &Model<'_>) -> Option<usize> {
        let weight = |d: usize| {
            self.best.demand[d] * self.misses[d] / f64::from(model.demands[d].needs + 1).ln()
        };
        let open = (0..model.demands.len())
            .filter(|&d| model.demands[d].members.len() > 1 && !self.counted[d]);
        open.max_by(|&a, &b| weight(a).total_cmp(&weight(b))).filter(|&d| weight(d) > 0.0)
    }

    /// Takes a demand out of the prizes, as paths are made to meet it.
    pub fn count(&mut self, model: &Model<'_>, demand: usize) {
        self.counted[demand] = true;
        self.best.demand[demand] = 0.0;
        self.best.price(model);
    }

    /// Begins again from the best multipliers, as when the paths have changed.
    pub fn restart(&mut self) {
        self.at = self.best.clone();
        self.direction.fill(0.0);
        self.step = (1.4 * self.step).max(0.1);
        self.stalled = 0;
    }

    /// One evaluation and one step towards `target`, a cost that some tour has or may have. Whether it was the last:
    /// the path proves that no further step helps, or the budget is spent.
    pub fn climb(
        &mut self,
        model: &Model<'_>,
        paths: &mut Relaxation<'_>,
        target: f64,
        budget: &mut Budget<'_>,
    ) -> bool {
        let Some(value) = paths.evaluate(&self.at.prices, budget) else { return true };
        self.at.bound = self.at.constant + value - self.at.rounding;
        let path = paths.path(&self.at.prices);
        if self.at.bound > self.best.bound {
            let gained = self.at.bound - self.best.bound;
            if gained > 1e-4 * (target - self.at.bound).abs() {
                self.stalled = 0;
            }
            self.best = self.at.clone();
        } else {
            self.stalled += 1;
        }
        if value == f64::INFINITY || self.best.bound >= target {
            return true;
        }
        if self.stalled >= 2 {
            self.stalled = 0;
            self.step *= 0.7;
        }
        let energy_j = if self.unit_j.is_some() { paths.energy_j(model, &path) } else { 0.0 };
        self.go(model, &path, energy_j, target)
    }

    fn go(&mut self, model: &Model<'_>, path: &[u32], energy_j: f64, target: f64) -> bool {
        let m = model.demands.len();
        let mut slope: Vec<f64> = model.demands.iter().map(|d| f64::from(d.needs)).collect();
        slope.extend(std::iter::repeat_n(-1.0, model.len()));
        for &stop in path {
            slope[m + stop as usize] += 1.0;
            for &d in &model.of[stop as usize] {
                slope[d as usize] -= 1.0;
            }
        }
        for (d, misses) in self.misses.iter_mut().enumerate() {
            *misses = 0.85 * *misses + 0.15 * slope[d].abs();
            if self.counted[d] {
                slope[d] = 0.0;
            }
        }
        slope.push(self.unit_j.map_or(0.0, |unit| (energy_j - model.wide.capacity_j) / unit));
        let multipliers = self.at.demand.iter().chain(&self.at.visit).chain([&self.at.energy]);
        // A multiplier at zero that would fall stays where it is.
        for (slope, &multiplier) in slope.iter_mut().zip(multipliers) {
            if multiplier <= 0.0 && *slope < 0.0 {
                *slope = 0.0;
            }
        }
        let norm: f64 = slope.iter().map(|g| g * g).sum();
        if norm == 0.0 {
            return true;
        }
        for (direction, slope) in self.direction.iter_mut().zip(&slope) {
            *direction = slope + 0.4 * *direction;
        }
        let size: f64 = self.direction.iter().map(|g| g * g).sum();
        let step = self.step * (target - self.at.bound).max(0.0) / size.max(norm);
        let (demand, visit) = (&mut self.at.demand, &mut self.at.visit);
        for (multiplier, direction) in demand.iter_mut().chain(visit).zip(&self.direction) {
            *multiplier = (*multiplier + step * direction).max(0.0);
        }
        if let Some(unit_j) = self.unit_j {
            let direction = self.direction[self.direction.len() - 1];
            self.at.energy = (self.at.energy + step * direction / unit_j).max(0.0);
        }
        self.at.price(model);
        false
    }
}
