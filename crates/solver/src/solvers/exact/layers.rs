//! Which resource layers the relaxed paths, and in how many intervals.

use super::incumbent::Incumbent;
use super::model::Model;
use super::network::Network;
use super::relaxation::Resource;

/// Layers of time or energy at first.
pub const INTERVALS: usize = 96;
const INTERVALS_OF_FEW: usize = 72;
/// Of energy, whose price makes up for what rounding gives away.
const INTERVALS_OF_ENERGY: usize = 48;
/// So many times as many where that makes every arc lead into a later one.
const FINER: f64 = 3.0;
/// Candidates at rest up to which a shortest tour is proven with fewer layers at first.
const FEW: usize = 64;
/// Arcs over all layers for which paths are laid out at all.
pub const MOST_ARRIVALS: usize = 60_000_000;

/// The resource whose limits bind the most.
pub fn resource(model: &Model<'_>) -> Resource {
    if model.energy_counts && !model.length_counts {
        Resource::Energy
    } else if model.time_counts {
        Resource::Time
    } else {
        Resource::Stops
    }
}

/// Whether metres are the cost, and so few candidates are at rest that one round may be the proof.
pub fn few(model: &Model<'_>) -> bool {
    model.length_counts && !model.wide.moving && model.len() <= FEW
}

/// Number of intervals and where they end.
pub fn layers(
    model: &Model<'_>,
    network: &Network,
    incumbent: &Incumbent,
    resource: Resource,
) -> (usize, f64) {
    let instance = &model.wide;
    let charger = &instance.scenario.charger;
    match resource {
        Resource::Stops => (model.len().max(1), 0.0),
        Resource::Energy => {
            let horizon = instance.capacity_j.max(1e-9);
            (INTERVALS_OF_ENERGY, horizon)
        }
        Resource::Time => {
            let reachable = (0..model.len()).filter(|&i| network.earliest_s[i].is_finite());
            let due = reachable.map(|i| instance.candidates[i].due_s).fold(0.0, f64::max);
            let mut horizon = due.min(instance.timespan_s);
            if model.length_counts && incumbent.cost.is_finite() {
                // No better tour is on its way for longer: it travels less, charges each once, and waits
                // at most until the last is ready.
                let charge_s = instance
                    .candidates
                    .iter()
                    .map(|c| c.charge_j(c.due_s.min(c.empty_s()).min(1e300)) / charger.transfer_w);
                let ready = instance.candidates.iter().map(|c| c.ready_s).fold(0.0, f64::max);
                let travel_s = incumbent.cost / charger.speed_mps;
                horizon = horizon.min(ready + charge_s.sum::<f64>() + travel_s);
            }
            if !horizon.is_finite() {
                // Nothing is scarce after the last deadline.
                let due = instance.candidates.iter().map(|c| c.due_s).filter(|due| due.is_finite());
                horizon = due.fold(1.0, f64::max);
            }
            let horizon = horizon.max(1e-9);
            if few(model) {
                return (INTERVALS_OF_FEW, horizon);
            }
            let arrive_later = horizon / network.least_step(model);
            (finer(network, INTERVALS, FINER, arrive_later), horizon)
        }
    }
}

/// So many intervals, or as many as make every arc lead into a later one, if those are at most so many `times` as many:
/// then no layer needs a second look.
fn finer(network: &Network, intervals: usize, times: f64, arrive_later: f64) -> usize {
    let fine = arrive_later.ceil();
    let few = fine <= times * intervals as f64
        && fine * network.arcs.len() as f64 <= MOST_ARRIVALS as f64;
    if few { (fine as usize + 1).max(intervals) } else { intervals }
}
