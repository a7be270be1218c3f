//! Every tour of a trivially small instance, depth first.
//!
//! Pruned only by what holds in general: once a deadline is missed or a limit is passed, it stays so.

use super::Budget;
use crate::instance::Instance;
use crate::tour::{Run, Tour, Value};

/// Up to this many candidates every tour is tried: at most 109,601 of them.
pub const MOST: usize = 8;

/// The best tour, or the best one seen before the budget ended.
pub fn enumerate(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Option<Vec<u32>> {
    let mut search = Enumeration { instance, order: Vec::new(), best: None };
    search.extend(&instance.departure(), budget);
    search.best.map(|(_, order)| order)
}

struct Enumeration<'a, 'b> {
    instance: &'a Instance<'b>,
    order: Vec<u32>,
    best: Option<(Value, Vec<u32>)>,
}

impl Enumeration<'_, '_> {
    fn extend(&mut self, run: &Run, budget: &mut Budget<'_>) {
        if self.instance.keeps_limits(&self.instance.finish(run)) {
            let value = Value::of(self.instance, &Tour::new(self.instance, &self.order));
            if self.best.as_ref().is_none_or(|(best, _)| value.beats(best)) {
                self.best = Some((value, self.order.clone()));
            }
        }
        for next in 0..self.instance.len() as u32 {
            if self.order.contains(&next) {
                continue;
            }
            let run = self.instance.step(run, next);
            let open = self.instance.in_time(&run)
                && run.depart_s <= self.instance.timespan_s
                && self.instance.energy_j(&run) <= self.instance.capacity_j;
            if open && budget.spend() {
                self.order.push(next);
                self.extend(&run, budget);
                self.order.pop();
            }
        }
    }
}
