//! The layers of relaxed paths: from which interval an arc leads into which, and where a tour may end.

use super::Model;
use super::network::{leg_m, stand};
use super::relaxation::{CLOSED, Graph, Relaxation, Resource};
use crate::tour::Run;

impl Relaxation<'_> {
    /// Halves the intervals. What is closed stays so: it was for everything later in its interval too.
    pub fn split(&mut self, model: &Model<'_>) {
        let (n, arcs) = (model.len(), self.network.arcs.len());
        self.intervals *= 2;
        self.width /= 2.0;
        self.ends = vec![f64::INFINITY; self.intervals * n];
        let fresh = self.lay_out(model);
        for graph in [&mut self.graph, &mut self.other] {
            let before = std::mem::replace(graph, fresh.clone());
            for b in 0..self.intervals {
                for a in 0..arcs {
                    if before.arrives[b / 2 * arcs + a] == CLOSED {
                        graph.arrives[b * arcs + a] = CLOSED;
                    }
                }
                let layer = n * self.tally.states;
                for place in 0..layer {
                    graph.live[b * layer + place] &= before.live[b / 2 * layer + place];
                }
            }
        }
        self.value = vec![f64::INFINITY; self.intervals * self.offset[n]];
    }

    /// Every arc and state that the limits allow; where a tour may begin and end.
    pub(super) fn lay_out(&mut self, model: &Model<'_>) -> Graph {
        let instance = &model.wide;
        let (n, arcs) = (model.len(), self.network.arcs.len());
        let tallies = self.tally.states;
        let mut graph = Graph {
            arrives: vec![CLOSED; self.intervals * arcs],
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
            let begin = b as f64 * self.width;
            for i in 0..n {
                let first = self.interval(self.least(i));
                if !self.network.earliest_s[i].is_finite() || b < first {
                    continue;
                }
                let mut run = self.at(model, i, begin);
                if run.arrive_s > instance.candidates[i].due_s {
                    continue;
                }
                run.distance_m = 0.0;
                graph.live[(b * n + i) * tallies..(b * n + i + 1) * tallies].fill(true);
                let spent_j = if self.resource == Resource::Energy {
                    begin.max(self.network.energy_j[i])
                } else {
                    self.network.energy_j[i]
                };
                let home = instance.finish(&run);
                let leg_j =
                    instance.scenario.charger.travel_jpm * leg_m(instance, i, instance.end());
                if home.arrive_s <= instance.timespan_s && spent_j + leg_j <= instance.capacity_j {
                    let length_m = leg_m(instance, i, instance.end());
                    self.ends[b * n + i] = if model.length_counts { length_m } else { 0.0 };
                }
                for arc in self.network.leaving(i) {
                    graph.arrives[b * arcs + arc] = self.arrival(model, i, arc, b, &run, spent_j);
                }
            }
        }
        graph
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
        from: usize,
        arc: usize,
        b: usize,
        run: &Run,
        spent_j: f64,
    ) -> u16 {
        let instance = &model.wide;
        let to = self.network.arcs[arc].to;
        let next = instance.step(run, to);
        if !instance.in_time(&next) || next.depart_s > instance.timespan_s {
            return CLOSED;
        }
        let leg_j = instance.scenario.charger.travel_jpm * leg_m(instance, from, to as usize);
        let energy_j = spent_j + leg_j + self.network.charge_j[to as usize];
        if energy_j > instance.capacity_j {
            return CLOSED;
        }
        match self.resource {
            Resource::Time => self.interval(next.arrive_s).max(b) as u16,
            Resource::Energy => self.interval(energy_j).max(b) as u16,
            Resource::Stops if b + 1 < self.intervals => b as u16 + 1,
            Resource::Stops => CLOSED,
        }
    }
}
