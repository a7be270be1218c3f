//! The layers of relaxed paths: from which interval an arc leads into which, and where a tour may end.

use super::Model;
use super::network::{leg_m, stand};
use super::relaxation::{Graph, Reading, Relaxation, Resource, Way};
use crate::solvers::Budget;
use crate::tour::Run;

impl Relaxation<'_> {
    /// Halves the intervals. What no tour may be in stays closed. What only no path may be in does not: paths over
    /// finer intervals are later, and come where none of them was before. Whether the budget lasted: if not, nothing
    /// more may be asked of these paths.
    #[must_use]
    pub fn split(&mut self, model: &Model<'_>, budget: &mut Budget<'_>) -> bool {
        let n = model.len();
        self.intervals *= 2;
        self.per_amount *= 2.0;
        self.ends = vec![f64::INFINITY; self.intervals * n];
        let Some(mut graph) = self.lay_out(model, budget) else { return false };
        let before = match self.reading {
            Reading::Tours => &self.graph,
            Reading::Paths => &self.other,
        };
        let layer = n * self.tally.states;
        let place = |at: usize, size: usize| at / size / 2 * size + at % size;
        for (at, live) in graph.live.iter_mut().enumerate() {
            *live &= before.live[place(at, layer)];
        }
        let fresh = std::mem::replace(&mut graph.first, vec![0]);
        let mut kept = 0;
        for at in 0..self.intervals * n {
            let open = before.leaving(place(at, n));
            for way in fresh[at]..fresh[at + 1] {
                let way = graph.ways[way];
                if open.binary_search_by_key(&way.arc, |way| way.arc).is_ok() {
                    graph.ways[kept] = way;
                    kept += 1;
                }
            }
            graph.first.push(kept);
        }
        graph.ways.truncate(kept);
        self.other = graph.clone();
        self.graph = graph;
        self.value = vec![f64::INFINITY; self.intervals * self.offset[n]];
        self.changed(true);
        true
    }

    /// Every arc and state that the limits allow; where a tour may begin and end. None if the budget ends before.
    pub(super) fn lay_out(&mut self, model: &Model<'_>, budget: &mut Budget<'_>) -> Option<Graph> {
        let instance = &model.wide;
        let n = model.len();
        let tallies = self.tally.states;
        let mut graph = Graph {
            first: vec![0],
            ways: Vec::new(),
            live: vec![false; self.intervals * n * tallies],
        };
        let start = instance.departure();
        let home = instance.finish(&start);
        if home.arrive_s <= instance.timespan_s && instance.energy_j(&home) <= instance.capacity_j {
            self.empty = if model.length_counts { home.distance_m } else { 0.0 };
        }
        let per_m = instance.scenario.charger.travel_jpm;
        let firsts = self.network.leaving(n).map(|a| {
            let to = self.network.arcs[a].to;
            let energy_j = per_m * leg_m(instance, instance.start(), to as usize)
                + self.network.charge_j[to as usize];
            match self.resource {
                Resource::Time => self.interval(instance.step(&start, to).arrive_s) as u16,
                Resource::Energy => self.interval(energy_j) as u16,
                Resource::Stops => 0,
            }
        });
        self.starts = firsts.collect();
        for b in 0..self.intervals {
            if !budget.lasts() {
                return None;
            }
            for i in 0..n {
                if let Some((run, spent_j)) = self.stay(model, b, i) {
                    graph.live[(b * n + i) * tallies..(b * n + i + 1) * tallies].fill(true);
                    self.ends[b * n + i] = self.end(model, &run, spent_j);
                    for (arc, a) in self.network.leaving(i).enumerate() {
                        if let Some(next) = self.arrival(model, a, b, &run, spent_j) {
                            graph.ways.push(Way { arc: arc as u16, next });
                        }
                    }
                }
                graph.first.push(graph.ways.len());
            }
        }
        Some(graph)
    }

    /// The charger at a candidate as early as the interval lets it be, and the energy spent by then; none if
    /// it cannot be there.
    fn stay(&self, model: &Model<'_>, b: usize, i: usize) -> Option<(Run, f64)> {
        let begin = b as f64 / self.per_amount;
        if !self.network.earliest_s[i].is_finite() || b < self.interval(self.least(i)) {
            return None;
        }
        let mut run = self.at(model, i, begin);
        run.distance_m = 0.0;
        let spent_j = if self.resource == Resource::Energy {
            begin.max(self.network.energy_j[i])
        } else {
            self.network.energy_j[i]
        };
        (run.arrive_s <= model.wide.candidates[i].due_s).then_some((run, spent_j))
    }

    /// What ending the tour costs; infinite where it cannot.
    fn end(&self, model: &Model<'_>, run: &Run, spent_j: f64) -> f64 {
        let instance = &model.wide;
        let home = instance.finish(run);
        let length_m = leg_m(instance, run.node as usize, instance.end());
        let leg_j = instance.scenario.charger.travel_jpm * length_m;
        if home.arrive_s > instance.timespan_s || spent_j + leg_j > instance.capacity_j {
            return f64::INFINITY;
        }
        if model.length_counts { length_m } else { 0.0 }
    }

    /// The resource that being at a candidate has taken at least.
    fn least(&self, candidate: usize) -> f64 {
        match self.resource {
            Resource::Time => self.network.earliest_s[candidate],
            Resource::Energy => self.network.energy_j[candidate],
            Resource::Stops => 0.0,
        }
    }

    /// The charger at a candidate, as early as the interval lets it be.
    fn at(&self, model: &Model<'_>, candidate: usize, begin: f64) -> Run {
        let earliest_s = self.network.earliest_s[candidate];
        let arrive_s =
            if self.resource == Resource::Time { begin.max(earliest_s) } else { earliest_s };
        stand(&model.wide, candidate, arrive_s)
    }

    fn arrival(
        &self,
        model: &Model<'_>,
        arc: usize,
        b: usize,
        run: &Run,
        spent_j: f64,
    ) -> Option<u16> {
        let instance = &model.wide;
        let arc = &self.network.arcs[arc];
        let energy_j = spent_j + arc.energy_j;
        if energy_j > instance.capacity_j {
            return None;
        }
        match self.resource {
            // The network has no arc that is late from the earliest stay on.
            Resource::Energy => Some(self.interval(energy_j).max(b) as u16),
            Resource::Stops => (b + 1 < self.intervals).then_some(b as u16 + 1),
            Resource::Time => {
                let candidate = &instance.candidates[arc.to as usize];
                let arrive_s = if instance.moving {
                    instance.step(run, arc.to).arrive_s
                } else {
                    candidate.ready_s.max(run.depart_s + arc.leg_s)
                };
                let charge_s = candidate.charge_j(arrive_s) * instance.transfer_spj;
                let late = arrive_s > candidate.due_s || arrive_s + charge_s > instance.timespan_s;
                (!late).then(|| self.interval(arrive_s).max(b) as u16)
            }
        }
    }
}
