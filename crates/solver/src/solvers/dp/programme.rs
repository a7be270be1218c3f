//! The programme: from v0 through the vertices in topological order.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::table::{Colours, Table};
use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::paper::{Attempt, PaperOptions, Unfinished};

/// The shortest colourful path with an all-zero table, as the time-discretised graph has it. A sensor is
/// reached up to a step too late in the graph, so that a tour which only keeps its deadlines without that is
/// not found: it is the best of those that keep them with every arrival rounded up to the step.
///
/// Deviations:
/// 1. The paper joins v0 to the first vertex of each sensor only, which forgets the time of the first leg; here
///    to the first one that the charger can reach.
/// 2. The charge is the one at the arrival (the paper's Definition of the charging time), not that at t0.
/// 3. The table has no row that another implies, and is not stored with each colour set: it follows from it.
/// 4. Of the paths with one colour set to one vertex the shortest is kept, of which the rest can only gain; the
///    paper keeps the set and looks for the shortest path as it traces back.
/// 5. The way back to v0 counts, as in the paper's problem; ready times, required requests and a time span are
///    kept too.
pub(in crate::solvers) fn dp(
    instance: &Instance<'_>,
    options: &PaperOptions,
    budget: &mut Budget<'_>,
) -> Attempt {
    let Some(table) = Table::new(instance) else { return Attempt::ended_by(Unfinished::Memory) };
    let mut programme = Programme {
        instance,
        table,
        step_s: options.dp_step_s,
        paths: Vec::new(),
        vertices: BTreeMap::new(),
        sets: 0,
        best: None,
    };
    if programme.table.is_met(0) {
        return Attempt::finished(Vec::new());
    }
    programme.extend(
        0,
        Place { node: instance.start() as u32, depart_s: 0.0, distance_m: 0.0 },
        NONE,
    );
    while let Some((vertices, sets)) = programme.vertices.pop_first() {
        for ((colour, set), path) in &sets {
            if programme.is_full(options.memory_bytes) {
                return Attempt::ended_by(Unfinished::Memory);
            }
            if budget.is_spent() {
                return Attempt::ended_by(Unfinished::Budget);
            }
            programme.visit(vertices.step, *colour, *set, *path);
            budget.spend();
        }
        programme.sets -= sets.len();
    }
    Attempt::finished(programme.trace_back())
}

/// No path before this one.
const NONE: u32 = u32::MAX;

/// Vertices of one step, with paths of one number of colours. In this order they are sorted topologically,
/// even where a charge and a leg together take no time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Vertices {
    step: u64,
    colours: u32,
}

/// A path to a vertex: its last colour, its length, and the path that it extends.
#[derive(Clone, Copy, Debug)]
struct Path {
    colour: u32,
    before: u32,
    distance_m: f64,
}

/// Where a path has come to.
#[derive(Clone, Copy, Debug)]
struct Place {
    node: u32,
    depart_s: f64,
    distance_m: f64,
}

/// The colour sets that are stored at the vertices of a kind, with the shortest path of each.
type Stored = FxHashMap<(u32, Colours), u32>;

struct Programme<'a, 'b> {
    instance: &'a Instance<'b>,
    table: Table,
    step_s: f64,
    paths: Vec<Path>,
    vertices: BTreeMap<Vertices, Stored>,
    /// Colour sets stored at vertices that are still to come.
    sets: usize,
    /// The shortest feasible path and its length.
    best: Option<(u32, f64)>,
}

impl Programme<'_, '_> {
    /// Looks at a colour set of a vertex: the end of a feasible path, or one to extend.
    fn visit(&mut self, step: u64, colour: u32, set: Colours, path: u32) {
        let candidate = self.table.candidates[colour as usize];
        let arrive_s = step as f64 * self.step_s;
        let charge_j = self.instance.candidates[candidate as usize].charge_j(arrive_s);
        let charger = &self.instance.scenario.charger;
        let depart_s = arrive_s + charge_j / charger.transfer_w;
        let distance_m = self.paths[path as usize].distance_m;
        if !self.table.is_met(set) {
            self.extend(set, Place { node: candidate, depart_s, distance_m }, path);
            return;
        }
        let leg_m = self.instance.distance_m(candidate as usize, self.instance.end());
        let in_time = depart_s + leg_m / charger.speed_mps <= self.instance.timespan_s;
        let length_m = distance_m + leg_m;
        if in_time && self.best.is_none_or(|(_, shortest_m)| length_m < shortest_m) {
            self.best = Some((path, length_m));
        }
    }

    /// Sends a colour set along the edges to the sensors that help.
    fn extend(&mut self, set: Colours, from: Place, before: u32) {
        for colour in 0..self.table.candidates.len() {
            let new = set | 1 << colour;
            if new == set || !self.table.helps(set, colour) {
                continue;
            }
            let to = self.table.candidates[colour] as usize;
            let leg_m = self.instance.distance_m(from.node as usize, to);
            let reach_s = from.depart_s + leg_m / self.instance.scenario.charger.speed_mps;
            let ready_s = self.instance.candidates[to].ready_s;
            let Some(step) = self.step_at(reach_s.max(ready_s)) else { continue };
            if step as f64 * self.step_s > self.instance.candidates[to].due_s {
                continue;
            }
            let distance_m = from.distance_m + leg_m;
            let path = Path { colour: colour as u32, before, distance_m };
            self.store(Vertices { step, colours: new.count_ones() }, new, path);
        }
    }

    /// The first step that is not before a time; `None` where steps can no longer be told apart.
    fn step_at(&self, time_s: f64) -> Option<u64> {
        const LAST: f64 = (1u64 << 52) as f64;
        let step = (time_s / self.step_s).ceil();
        (step < LAST).then(|| step as u64 + u64::from(step * self.step_s < time_s))
    }

    fn store(&mut self, vertices: Vertices, set: Colours, path: Path) {
        let stored = self.vertices.entry(vertices).or_default();
        if let Some(&known) = stored.get(&(path.colour, set)) {
            let known = &mut self.paths[known as usize];
            if path.distance_m < known.distance_m {
                *known = path;
            }
            return;
        }
        stored.insert((path.colour, set), self.paths.len() as u32);
        self.paths.push(path);
        self.sets += 1;
    }

    /// Whether the memory in use, estimated from above, is more than that.
    fn is_full(&self, memory_bytes: usize) -> bool {
        // A table is up to seven eighths full and twice as large after it has grown; a step has one.
        const SET: usize = 3 * size_of::<((u32, Colours), u32)>();
        const STEP: usize = 256;
        let paths = 2 * self.paths.len() * size_of::<Path>();
        let bytes = paths + self.sets * SET + self.vertices.len() * STEP;
        // An index of a path is a u32.
        bytes > memory_bytes || self.paths.len() + self.table.candidates.len() >= NONE as usize
    }

    /// The stops of the shortest feasible path; none where there is no such path.
    fn trace_back(&self) -> Vec<u32> {
        let mut order = Vec::new();
        let mut path = self.best.map_or(NONE, |(path, _)| path);
        while path != NONE {
            let here = self.paths[path as usize];
            order.push(self.table.candidates[here.colour as usize]);
            path = here.before;
        }
        order.reverse();
        order
    }
}
