//! The colonies: iterations of ants, and what each leaves to the next.

use rand_pcg::Pcg64Mcg;

use super::AcsOptions;
use super::ant::Ant;
use super::trail::Trail;
use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::paper::{Attempt, PaperOptions, Unfinished};
use crate::tour::{Tour, Value};

/// The shortest feasible tour of all ants.
pub(in crate::solvers) fn acs(
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
