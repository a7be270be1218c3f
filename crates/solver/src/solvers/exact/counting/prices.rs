//! Lagrangian prices under which relaxed paths make so many stops, and none twice.

use super::{Tails, Timetable};
use crate::instance::Instance;
use crate::solvers::Budget;

/// Any prices give a bound on the end of every tour with `stops` stops; see [`Prices::fixed_s`].
#[derive(Clone, Debug)]
pub struct Prices {
    /// The number of stops asked for.
    pub stops: usize,
    /// Seconds by which each stop is worth delaying the end.
    stop_s: f64,
    /// By candidate, seconds that a visit is charged so that nobody is visited twice; not negative.
    visit_s: Vec<f64>,
    /// The bound that was found, in seconds.
    pub bound_s: f64,
}

/// Length of the first step, of the first one from prices that have climbed before, and what becomes of it
/// when the bound has stalled.
const FIRST_STEP: f64 = 1.0;
const NEXT_STEP: f64 = 0.3;
const SHORTER: f64 = 0.7;
const PATIENCE: u32 = 3;
/// Share of the direction before that is kept.
const KEPT: f64 = 0.4;

impl Prices {
    /// Those of a knapsack: every candidate is worth what its charge takes, up to the dearest of the `stops`
    /// cheapest; what the charges leave of the time is halfway taken for travel.
    pub fn begin(instance: &Instance<'_>, charges_s: &[f64], stops: usize) -> Self {
        let mut sorted = charges_s.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (dearest_s, sum_s) = (sorted[stops - 1], sorted[..stops].iter().sum::<f64>());
        let travel_s = 0.5 * (instance.timespan_s - sum_s).max(0.0) / stops as f64;
        Self {
            stops,
            stop_s: dearest_s + travel_s,
            visit_s: charges_s.iter().map(|charge_s| (dearest_s - charge_s).max(0.0)).collect(),
            bound_s: f64::NEG_INFINITY,
        }
    }

    /// By candidate, seconds by which a visit is worth delaying the end.
    pub fn prizes(&self) -> Vec<f64> {
        self.visit_s.iter().map(|visit_s| self.stop_s - visit_s).collect()
    }

    /// What a tour of so many stops adds to its end less its prizes: then what is charged to the candidates that
    /// it leaves out is missing, so that it is not later than the tour ends.
    pub fn fixed_s(&self) -> f64 {
        self.stops as f64 * self.stop_s - self.visit_s.iter().sum::<f64>()
    }

    /// How far rounding may have moved a bound.
    pub fn rounding_s(&self) -> f64 {
        let prices_s = self.visit_s.iter().sum::<f64>() + self.stops as f64 * self.stop_s.abs();
        1e-12 * (1.0 + prices_s + self.bound_s.abs().min(prices_s))
    }

    /// The fewest stops more than asked for of which the bound shows that they end after `limit_s`, if any.
    pub fn too_many(&self, limit_s: f64) -> Option<usize> {
        let missing = (limit_s - self.bound_s + self.rounding_s()) / self.stop_s;
        let more = self.stop_s > 0.0 && self.bound_s.is_finite() && (0.0..1e9).contains(&missing);
        more.then(|| self.stops + missing as usize + 1)
    }

    /// Climbs by deflected subgradients, in at most so many steps, until the bound exceeds `limit_s`.
    pub fn climb(
        &mut self,
        table: &Timetable,
        firsts_s: &[f64],
        limit_s: f64,
        steps: u32,
        budget: &mut Budget<'_>,
    ) {
        let n = table.n;
        let mut tails = Tails::new(table);
        let mut at = self.clone();
        let mut length = if self.bound_s.is_finite() { NEXT_STEP } else { FIRST_STEP };
        let mut stalled = 0;
        self.bound_s = f64::NEG_INFINITY;
        let mut direction = vec![0.0; n + 1];
        for _step in 0..steps {
            tails.evaluate(&at.prizes());
            let (value, path) = tails.path(firsts_s);
            at.bound_s = value + at.fixed_s();
            at.bound_s -= at.rounding_s();
            if at.bound_s > self.bound_s {
                *self = at.clone();
                stalled = 0;
            } else {
                stalled += 1;
            }
            if self.bound_s > limit_s || !budget.spend() {
                break;
            }
            if stalled >= PATIENCE {
                (stalled, length) = (0, length * SHORTER);
            }
            let slope = at.slope(&path);
            let norm: f64 = slope.iter().map(|g| g * g).sum();
            if norm == 0.0 {
                break;
            }
            for (direction, slope) in direction.iter_mut().zip(&slope) {
                *direction = slope + KEPT * *direction;
            }
            let size: f64 = direction.iter().map(|d| d * d).sum();
            let target_s = limit_s + 0.01 * limit_s;
            let step = length * (target_s - at.bound_s) / size.max(norm);
            at.stop_s += step * direction[n];
            for (visit_s, direction) in at.visit_s.iter_mut().zip(&direction) {
                *visit_s = (*visit_s + step * direction).max(0.0);
            }
        }
    }

    /// How the bound changes with the price of each visit, and last with that of all stops.
    fn slope(&self, path: &[u32]) -> Vec<f64> {
        let n = self.visit_s.len();
        let mut slope = vec![-1.0; n + 1];
        path.iter().for_each(|&stop| slope[stop as usize] += 1.0);
        for (slope, &visit_s) in slope.iter_mut().zip(&self.visit_s) {
            if visit_s <= 0.0 && *slope < 0.0 {
                *slope = 0.0;
            }
        }
        slope[n] = self.stops as f64 - path.len() as f64;
        slope
    }
}
