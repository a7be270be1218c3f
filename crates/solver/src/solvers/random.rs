//! The paper's Random (section "Comparison Algorithms" of the optimal k-coverage charging problem): a random
//! walk over sensors in reach, many times, the best kept.
//!
//! Deviation: only over sensors that help, unless the walk is to be `literal`.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Budget;
use super::greedy::append;
use super::paper::PaperOptions;
use crate::instance::Instance;
use crate::tour::{Tour, Value};

/// The best of as many random walks as the options ask for.
pub fn random(
    instance: &Instance<'_>,
    options: &PaperOptions,
    rng: &mut Pcg64Mcg,
    budget: &mut Budget<'_>,
) -> Vec<u32> {
    let mut best = (Vec::new(), Value::of(instance, &Tour::new(instance, &[])));
    for _ in 0..options.walks {
        if budget.is_spent() {
            break;
        }
        let order = append(instance, options.literal, budget, |open| {
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
