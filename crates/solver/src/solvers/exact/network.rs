//! The arcs that a feasible tour may use, and bounds on the time and energy at which it uses them.

use super::Model;
use crate::instance::Instance;
use crate::tour::Run;

/// An arc from a candidate, or from the start, to a candidate.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    /// Where it leads.
    pub to: u32,
    /// What travelling it costs at least.
    pub cost: f64,
    /// How long travelling it takes, in seconds; where nothing moves.
    pub leg_s: f64,
    /// Energy that travelling it and the charge at its end take at least, in joules.
    pub energy_j: f64,
}

/// The arcs between candidates that some feasible tour may use.
#[derive(Debug)]
pub struct Network {
    /// By candidate, and last the start: where its arcs begin in `arcs`.
    pub first: Vec<usize>,
    /// By place they leave.
    pub arcs: Vec<Arc>,
    /// By candidate, when charging begins there at the earliest, in seconds; infinite if it cannot be served.
    pub earliest_s: Vec<f64>,
    /// By candidate, energy delivered there at least, in joules.
    pub charge_j: Vec<f64>,
    /// By candidate, energy spent once it is charged, at least, in joules.
    pub energy_j: Vec<f64>,
    /// By candidate, and last the start: energy that the way to the end takes at least, in joules.
    pub home_j: Vec<f64>,
}

impl Network {
    /// Those of all arcs that a tour which costs less than `cutoff` may use, as far as can be told before anything is
    /// laid out.
    pub fn new(model: &Model<'_>, cutoff: f64) -> Self {
        let instance = &model.wide;
        let n = instance.len();
        let earliest_s = earliest(model);
        let charge_j: Vec<f64> =
            (0..n).map(|i| instance.candidates[i].charge_j(earliest_s[i].min(1e300))).collect();
        let energy_j = least_energy(model, &charge_j);
        let tail_j = tail_energy(model, &charge_j);
        let per_m = instance.scenario.charger.travel_jpm;
        let home_j = (0..=n).map(|from| per_m * leg_m(instance, from, instance.end())).collect();
        let mut network =
            Self { first: vec![0], arcs: Vec::new(), earliest_s, charge_j, energy_j, home_j };
        for from in 0..=n {
            for to in 0..n {
                if from != to && network.allows(model, from, to, &tail_j) {
                    let leg_m = leg_m(instance, from, to);
                    let cost = if model.length_counts { leg_m } else { 0.0 };
                    let energy_j = per_m * leg_m + network.charge_j[to];
                    let leg_s = leg_m * instance.travel_spm;
                    network.arcs.push(Arc { to: to as u32, cost, leg_s, energy_j });
                }
            }
            network.first.push(network.arcs.len());
        }
        network.thin(model, cutoff);
        // Near ones first: their heads remember more of what their tails do.
        for from in 0..=n {
            let leaving = network.leaving(from);
            network.arcs[leaving]
                .sort_unstable_by(|a, b| a.leg_s.total_cmp(&b.leg_s).then(a.to.cmp(&b.to)));
        }
        network
    }

    /// The arcs that leave a place.
    pub fn leaving(&self, place: usize) -> std::ops::Range<usize> {
        self.first[place]..self.first[place + 1]
    }

    /// Keeps of the arcs those for which this holds of the place they leave and the arc.
    pub fn retain(&mut self, keep: impl Fn(usize, &Arc) -> bool) {
        let first = std::mem::replace(&mut self.first, vec![0]);
        let mut kept = 0;
        for (from, arcs) in first.windows(2).enumerate() {
            for a in arcs[0]..arcs[1] {
                if keep(from, &self.arcs[a]) {
                    self.arcs[kept] = self.arcs[a];
                    kept += 1;
                }
            }
            self.first.push(kept);
        }
        self.arcs.truncate(kept);
    }

    /// Time from the beginning of one charge to the next, at least, in seconds.
    pub fn least_step(&self, model: &Model<'_>) -> f64 {
        let arcs = (0..model.len()).flat_map(|from| self.leaving(from).map(move |a| (from, a)));
        let steps = arcs.map(|(from, a)| {
            let run = stand(&model.wide, from, self.earliest_s[from]);
            model.wide.step(&run, self.arcs[a].to).arrive_s - self.earliest_s[from]
        });
        steps.fold(f64::INFINITY, f64::min)
    }

    fn allows(&self, model: &Model<'_>, from: usize, to: usize, tail_j: &[f64]) -> bool {
        let instance = &model.wide;
        if !self.earliest_s[to].is_finite() || !asked(model, to) {
            return false;
        }
        let (run, spent_j) = if from == instance.start() {
            (instance.departure(), 0.0)
        } else if self.earliest_s[from].is_finite() && asked(model, from) {
            (stand(instance, from, self.earliest_s[from]), self.energy_j[from])
        } else {
            return false;
        };
        let next = instance.step(&run, to as u32);
        let leg_j = instance.scenario.charger.travel_jpm * leg_m(instance, from, to);
        instance.in_time(&next)
            && next.depart_s <= instance.timespan_s
            && spent_j + leg_j + self.charge_j[to] + tail_j[to] <= instance.capacity_j
    }
}

/// Whether a candidate is ever worth a stop.
fn asked(model: &Model<'_>, candidate: usize) -> bool {
    !model.useful_only || !model.of[candidate].is_empty()
}

/// The charger at a candidate where charging began at a given time.
pub fn stand(instance: &Instance<'_>, candidate: usize, arrive_s: f64) -> Run {
    let c = &instance.candidates[candidate];
    let scenario = instance.scenario;
    let charge_j = c.charge_j(arrive_s);
    let place = scenario.sensors[scenario.requests[c.request].sensor].place.at(arrive_s);
    Run {
        node: candidate as u32,
        place: if instance.moving { place } else { c.point },
        arrive_s,
        depart_s: arrive_s + charge_j * instance.transfer_spj,
        distance_m: 0.0,
        charge_j,
    }
}

/// What the way between two places measures at least, in metres.
pub fn leg_m(instance: &Instance<'_>, from: usize, to: usize) -> f64 {
    // Where a moving sensor is met is not known beforehand.
    if instance.moving { 0.0 } else { instance.distance_m(from, to) }
}

/// When charging begins at each candidate at the earliest, over any other stops. Arriving later never
/// lets one leave earlier, so the nearest in time is settled next.
fn earliest(model: &Model<'_>) -> Vec<f64> {
    let instance = &model.wide;
    let n = instance.len();
    let mut arrive_s = vec![f64::INFINITY; n];
    let mut settled = vec![false; n];
    let mut run = Some(instance.departure());
    while let Some(from) = run {
        for to in 0..n {
            if !settled[to] {
                let next = instance.step(&from, to as u32);
                if instance.in_time(&next) && next.depart_s <= instance.timespan_s {
                    arrive_s[to] = arrive_s[to].min(next.arrive_s);
                }
            }
        }
        let open = (0..n).filter(|&i| !settled[i] && arrive_s[i].is_finite());
        let next = open.min_by(|&a, &b| arrive_s[a].total_cmp(&arrive_s[b]));
        run = next.map(|i| {
            settled[i] = true;
            stand(instance, i, arrive_s[i])
        });
    }
    arrive_s
}

fn least_energy(model: &Model<'_>, charge_j: &[f64]) -> Vec<f64> {
    let instance = &model.wide;
    let per_m = instance.scenario.charger.travel_jpm;
    let from_start = |i| per_m * leg_m(instance, instance.start(), i) + charge_j[i];
    let first = (0..instance.len()).map(from_start).collect();
    settle(first, |from, to| per_m * leg_m(instance, from, to) + charge_j[to])
}

fn tail_energy(model: &Model<'_>, charge_j: &[f64]) -> Vec<f64> {
    let instance = &model.wide;
    let per_m = instance.scenario.charger.travel_jpm;
    let to_end = |i| per_m * leg_m(instance, i, instance.end());
    let last = (0..instance.len()).map(to_end).collect();
    settle(last, |later, earlier| per_m * leg_m(instance, earlier, later) + charge_j[later])
}

/// Shortest distances of all from a source, of which `values` are the direct ones; no step is less than zero.
pub fn settle(mut values: Vec<f64>, step: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let mut settled = vec![false; values.len()];
    for _ in 0..values.len() {
        let open = (0..values.len()).filter(|&i| !settled[i]);
        let Some(next) = open.min_by(|&a, &b| values[a].total_cmp(&values[b])) else { break };
        settled[next] = true;
        for other in 0..values.len() {
            if !settled[other] {
                values[other] = values[other].min(values[next] + step(next, other));
            }
        }
    }
    values
}
