//! The paper's Random (section 6.3.2): a random walk over sensors that help, many times, the best kept.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Budget;
use super::greedy::append;
use crate::instance::Instance;
use crate::tour::{Tour, Value};

/// Walks without a time limit.
const WALKS: usize = 100;

/// The best of [`WALKS`] random walks.
pub fn random(instance: &Instance<'_>, rng: &mut Pcg64Mcg, budget: &mut Budget<'_>) -> Vec<u32> {
    let mut best = (Vec::new(), Value::of(instance, &Tour::new(instance, &[])));
    for _ in 0..WALKS {
        if budget.is_spent() {
            break;
        }
        let order = append(instance, budget, |open| {
            (!open.is_empty()).then(|| open[rng.random_range(0..open.len())].0)
        });
        let tour = Tour::new(instance, &order);
        let value = Value::of(instance, &tour);
        if tour.is_legal() && value.beats(&best.1) {
            best = (order, value);
        }
    }
    best.0
}
