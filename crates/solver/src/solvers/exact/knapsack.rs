//! The knapsack in a tour: each stop takes of what is scarce its charge and, at least, the way from its nearest
//! neighbour.

use super::Model;
use super::layers::resource;
use super::multipliers::Ascent;
use super::network::{Network, leg_m, settle};
use super::relaxation::Resource;

/// Arcs are told apart under the price at which the best candidates fill this share of the capacity. A tour holds
/// fewer stops than the knapsack: its energy is worth more.
const SHARE: f64 = 0.25;

/// What each candidate takes of the resource at least, or about so much where sensors move; and how much there is.
pub fn takes(model: &Model<'_>, resource: Resource) -> (Vec<f64>, f64) {
    let instance = &model.wide;
    let charger = &instance.scenario.charger;
    let near_m = |i: usize| {
        let others = (0..model.len()).filter(|&other| other != i);
        others.map(|other| apart_m(model, other, i)).fold(f64::INFINITY, f64::min)
    };
    let takes = |i: usize| {
        let charge_j = instance.candidates[i].charge_j(0.0);
        match resource {
            Resource::Time => charge_j / charger.transfer_w + near_m(i) / charger.speed_mps,
            Resource::Energy => charge_j + charger.travel_jpm * near_m(i),
            Resource::Stops => f64::INFINITY,
        }
    };
    let limit = match resource {
        Resource::Time => instance.timespan_s,
        Resource::Energy => instance.capacity_j,
        Resource::Stops => f64::INFINITY,
    };
    ((0..model.len()).map(takes).collect(), limit)
}

impl Network {
    /// Where energy is scarce, metres cost nothing and nothing moves: closes arcs that no tour takes which costs less
    /// than `cutoff`.
    ///
    /// What a stop is worth beyond the energy that it takes at least is charged for the visit. No arc between
    /// candidates then costs less than nothing, so that the cheapest way to its tail and from its head, whatever
    /// energy that takes, bounds every tour that takes it.
    pub fn thin(&mut self, model: &Model<'_>, cutoff: f64) {
        let instance = &model.wide;
        if resource(model) != Resource::Energy || instance.moving || cutoff == f64::INFINITY {
            return;
        }
        let (takes, capacity_j) = takes(model, Resource::Energy);
        let mut ascent = Ascent::new(model, true);
        ascent.begin_knapsack(model, &takes, SHARE * capacity_j);
        let knapsack = ascent.best;
        if knapsack.prices.per_j <= 0.0 {
            return;
        }
        let per_m = instance.scenario.charger.travel_jpm;
        let cost = |from: usize, to: usize| {
            let energy_j = per_m * leg_m(instance, from, to) + self.charge_j[to];
            knapsack.prices.per_j * energy_j - knapsack.prices.prizes[to]
        };
        let n = model.len();
        let reach = settle((0..n).map(|to| cost(instance.start(), to)).collect(), cost);
        let ends = self.home_j[..n].iter().map(|home_j| knapsack.prices.per_j * home_j).collect();
        let go_on = settle(ends, |later, earlier| cost(earlier, later));
        let most = cutoff - knapsack.constant + knapsack.rounding;
        self.retain(|from, arc| {
            let before = if from == instance.start() { 0.0 } else { reach[from] };
            before + knapsack.prices.of(arc) + go_on[arc.to as usize] < most
        });
    }
}

/// Roughly how far two candidates are apart, in metres.
pub fn apart_m(model: &Model<'_>, a: usize, b: usize) -> f64 {
    if model.wide.moving {
        (model.wide.candidates[a].point - model.wide.candidates[b].point).norm()
    } else {
        model.wide.distance_m(a, b)
    }
}
