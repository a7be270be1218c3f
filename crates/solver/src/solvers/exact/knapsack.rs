//! The knapsack in a tour: each stop takes of what is scarce its charge and, at least, the way from its nearest
//! neighbour.

use super::Model;
use super::multipliers::Ascent;
use super::network::{Network, leg_m, settle};
use super::relaxation::Resource;

/// Arcs are told apart under the price at which the best candidates fill this share of the capacity. A tour holds
/// fewer stops than the knapsack: its energy is worth more.
const SHARE: f64 = 0.25;

/// What each candidate takes of the resource, with a typical way to it; and how much there is.
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

/// Closes arcs between candidates at rest that no tour takes which costs less than `cutoff`, where energy is scarce and
/// metres cost nothing.
///
/// What a stop is worth beyond the energy that it takes at least is charged for the visit. No arc then costs less than
/// nothing, so that the cheapest way to its tail and from its head, whatever energy that takes, bounds every tour
/// that takes it.
pub fn thin(network: &mut Network, model: &Model<'_>, cutoff: f64) {
    if cutoff == f64::INFINITY {
        return;
    }
    let (takes, capacity_j) = takes(model, Resource::Energy);
    let mut ascent = Ascent::new(model, true);
    ascent.begin_knapsack(model, &takes, SHARE * capacity_j);
    let (prices, instance) = (&ascent.best.prices, &model.wide);
    if prices.per_j <= 0.0 {
        return;
    }
    let per_m = instance.scenario.charger.travel_jpm;
    let cost = |from: usize, to: usize| {
        let energy_j = per_m * leg_m(instance, from, to) + network.charge_j[to];
        prices.per_j * energy_j - prices.prizes[to]
    };
    let n = model.len();
    let reach = settle((0..n).map(|to| cost(n, to)).collect(), cost);
    let ends = network.home_j[..n].iter().map(|home_j| prices.per_j * home_j).collect();
    let go_on = settle(ends, |later, earlier| cost(earlier, later));
    let most = cutoff - ascent.best.constant + ascent.best.rounding;
    let before = |from: usize| if from == n { 0.0 } else { reach[from] };
    network.retain(|from, arc| before(from) + prices.of(arc) + go_on[arc.to as usize] < most);
}

/// Roughly how far two candidates are apart, in metres.
pub fn apart_m(model: &Model<'_>, a: usize, b: usize) -> f64 {
    if model.wide.moving {
        (model.wide.candidates[a].point - model.wide.candidates[b].point).norm()
    } else {
        model.wide.distance_m(a, b)
    }
}
