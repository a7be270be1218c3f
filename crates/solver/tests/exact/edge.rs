//! Limits placed where a tour just keeps, or just breaks them: a hair on either side of what a solver
//! allows itself, and of what the check accepts.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use voltour_solver::scenario::{Document, Scenario};
use voltour_solver::tolerance::tolerance;

use crate::draw::one;
use crate::journey::Journey;
use crate::truth::{Truth, candidates, needs};

/// Tolerances by which the tour exceeds its limits.
const STRAINS: [f64; 9] = [-0.5, 0.0, 0.25, 0.45, 0.55, 0.75, 0.95, 1.05, 1.5];

/// Changes limits of a scenario so that they hang on one of its tours: the best one, or any.
pub fn sharpen(document: &mut Document, rng: &mut Pcg64Mcg) {
    let scenario = Scenario::from_document(document).unwrap();
    let best = Truth::of(&scenario, &needs(&scenario)).accepted;
    let order = match best.filter(|_| rng.random_bool(0.7)) {
        Some(best) => best.order,
        None => some_order(&scenario, rng),
    };
    let home = Journey::along(&scenario, &order);
    let which = rng.random_range(1..8_u8);
    let near =
        |needs: f64, rng: &mut Pcg64Mcg| (needs - one(rng, &STRAINS) * tolerance(needs)).max(0.0);
    if which & 1 == 1 {
        document.charger.timespan_s = Some(near(home.time_s, rng));
    }
    if which & 2 == 2 {
        document.charger.capacity_j = Some(near(home.energy_j(&scenario), rng));
    }
    if which & 4 == 4 {
        let mut at = Journey::begin(&scenario);
        for &stop in &order {
            at = at.visit(&scenario, stop);
            let request = &mut document.requests[stop];
            // A residual left out would follow the deadline.
            request.residual_j = Some(scenario.requests[stop].residual_j);
            if rng.random_bool(0.6) {
                let ready_s = request.ready_s.unwrap_or(0.0);
                request.deadline_s = Some(near(at.arrive_s, rng).max(ready_s));
            }
        }
    }
}

fn some_order(scenario: &Scenario, rng: &mut Pcg64Mcg) -> Vec<usize> {
    let mut order = candidates(scenario);
    for i in (1..order.len()).rev() {
        order.swap(i, rng.random_range(0..=i));
    }
    order.truncate(rng.random_range(0..=order.len()));
    order
}
