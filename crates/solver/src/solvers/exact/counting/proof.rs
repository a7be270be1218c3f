//! The proof that no tour serves one candidate more than the best that is found.

use super::{Outcome, Prices, Stages, Tails, Timetable};
use crate::scenario::Objective;
use crate::solvers::Budget;
use crate::solvers::exact::prove::Proof;
use crate::solvers::exact::{Aim, Effort, Incumbent, Model};

/// How closely a number of stops is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Intervals of the timetable.
    pub intervals: usize,
    /// Steps in which prices climb.
    pub steps: u32,
    /// Labels kept of each number of stops.
    pub width: usize,
}

/// The first look is a glance that decides most instances; the next ones find tours, and prove what prices
/// prove alone; those after them take many times longer each.
const LOOKS: [Look; 6] = [
    Look { intervals: 80, steps: 20, width: 100 },
    Look { intervals: 200, steps: 30, width: 500 },
    Look { intervals: 800, steps: 15, width: 4_000 },
    Look { intervals: 2_000, steps: 10, width: 12_000 },
    Look { intervals: 3_584, steps: 12, width: 100_000 },
    Look { intervals: 7_168, steps: 12, width: usize::MAX },
];
/// So many looks begin with prices of their own: those that climbed at a glance lead astray.
const GLANCES: usize = 1;
/// Hops that a timetable may have: 8 bytes each.
const MOST_HOPS: usize = 16_000_000;
/// Looks that are a share of a planner's time, and the hops of a timetable that is.
const SHARE: usize = 4;
const SHARE_HOPS: usize = 2_000_000;
/// Memory for labels.
const MOST_BYTES: usize = 600 << 20;

/// Whether time is all that runs out, everyone counts the same, and leaving out the last stops leaves a tour
/// that keeps its limits: then so many stops are possible if more are.
pub fn applies(model: &Model<'_>, incumbent: &Incumbent) -> bool {
    let instance = &model.wide;
    instance.scenario.objective == Objective::MaxCount
        && model.aim == Aim::Optimum
        && model.direct
        && model.demands.is_empty()
        && !model.energy_counts
        && instance.timespan_s.is_finite()
        && (1..=128).contains(&model.len())
        && incumbent.order.is_some()
}

/// Finds more stops, or proves that there is no tour with more, as long as the effort and the budget allow.
pub fn count(
    model: &Model<'_>,
    effort: Effort,
    incumbent: &mut Incumbent,
    budget: &mut Budget<'_>,
) -> Proof {
    let (most, most_hops) = match effort {
        Effort::Whole => (LOOKS.len(), MOST_HOPS),
        Effort::Share => (SHARE, SHARE_HOPS),
    };
    let fits = |look: &&Look| model.len() * model.len() * look.intervals <= most_hops;
    let looks = &LOOKS[..LOOKS[..most].iter().take_while(fits).count()];
    if model.len() <= 64 {
        count_with::<1>(model, looks, incumbent, budget)
    } else {
        count_with::<2>(model, looks, incumbent, budget)
    }
}

pub(super) fn count_with<const W: usize>(
    model: &Model<'_>,
    looks: &[Look],
    incumbent: &mut Incumbent,
    budget: &mut Budget<'_>,
) -> Proof {
    let mut counter = Counter::new(model, looks);
    loop {
        let known = -incumbent.cost.min(incumbent.beyond);
        let stops = known as usize + 1;
        let outcome = counter.decide::<W>(stops, budget);
        if let Outcome::Found(orders) = outcome {
            for order in orders {
                let before = incumbent.cost;
                incumbent.offer_wide(model, order);
                if incumbent.cost < before {
                    break;
                }
            }
            continue;
        }
        let closed = matches!(outcome, Outcome::None);
        let most = if closed { known } else { counter.most as f64 };
        let bound = (-most).min(incumbent.cost).min(incumbent.beyond);
        return Proof { order: incumbent.order.clone(), bound, closed };
    }
}

struct Counter<'c> {
    model: &'c Model<'c>,
    looks: &'c [Look],
    /// By look, made when it is needed.
    tables: Vec<Timetable>,
    /// By candidate, seconds that charging takes at least.
    charges_s: Vec<f64>,
    /// By candidate, when it is reached as the first stop; infinite where that is too late.
    firsts_s: Vec<f64>,
    /// No tour has more stops.
    most: usize,
}

impl<'c> Counter<'c> {
    fn new(model: &'c Model<'_>, looks: &'c [Look]) -> Self {
        let instance = &model.wide;
        let charger = &instance.scenario.charger;
        let charges = instance.candidates.iter().map(|c| c.charge_j(0.0) / charger.transfer_w);
        let first = |to: u32| {
            let run = instance.step(&instance.departure(), to);
            let in_time = instance.in_time(&run) && run.depart_s <= instance.timespan_s;
            if in_time { run.arrive_s } else { f64::INFINITY }
        };
        Self {
            model,
            looks,
            tables: Vec::new(),
            charges_s: charges.collect(),
            firsts_s: (0..model.len() as u32).map(first).collect(),
            most: model.len(),
        }
    }

    /// Whether some tour makes so many stops.
    fn decide<const W: usize>(&mut self, stops: usize, budget: &mut Budget<'_>) -> Outcome {
        let instance = &self.model.wide;
        let limit_s = instance.timespan_s;
        if stops > self.most || self.charging_s(stops) > limit_s {
            return Outcome::None;
        }
        let mut prices = Prices::begin(instance, &self.charges_s, stops);
        for (look, &Look { intervals, steps, width }) in self.looks.iter().enumerate() {
            if look == self.tables.len() {
                let Some(table) = Timetable::new(instance, intervals, budget) else { break };
                self.tables.push(table);
            }
            let table = &self.tables[look];
            if look == GLANCES {
                prices = Prices::begin(instance, &self.charges_s, stops);
            }
            prices.climb(table, &self.firsts_s, limit_s, steps, budget);
            if prices.bound_s > limit_s {
                return Outcome::None;
            }
            let mut tails = Tails::new(table);
            tails.evaluate(&prices.prizes());
            if let Some(too_many) = prices.too_many(limit_s) {
                self.most = self.most.min(too_many - 1);
            }
            if budget.is_spent() {
                break;
            }
            let width = width.min(MOST_BYTES / Stages::bytes::<W>(stops));
            let stages = Stages { instance, tails: &tails, prices: &prices, width };
            let outcome = stages.run::<W>(budget);
            if !matches!(outcome, Outcome::Cut) || budget.is_spent() {
                return outcome;
            }
        }
        Outcome::Cut
    }

    /// Seconds that so many charges take at least, less what rounding may be.
    fn charging_s(&self, stops: usize) -> f64 {
        let mut charges_s = self.charges_s.clone();
        charges_s.sort_by(f64::total_cmp);
        charges_s[..stops].iter().sum::<f64>() * (1.0 - 1e-12)
    }
}
