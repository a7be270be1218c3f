//! The scenario as a set of constraints of which any may be dropped, and the question whether some of
//! them can be kept together.
//!
//! Places, ready times, charges, the speed: what no operator can wish away is background and never dropped.

use super::meter::Meter;
use crate::coverage::{self, Demand};
use crate::instance::Instance;
use crate::scenario::{Place, Point, Request, Scenario};
use crate::solvers::exact::Verdict;
use crate::tour::{Tour, Value};

/// So many tours are tried before a question is asked.
const REMEMBERED: usize = 32;

/// One constraint, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// A demand of coverage.
    Cover(usize),
    /// A request is required.
    Required(usize),
    /// The deadline of a request.
    Deadline(usize),
    Timespan,
    Capacity,
}

/// What is known of some constraints; a tour is requests in order.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    Feasible(Vec<usize>),
    Infeasible,
    Unknown,
}

/// The constraints of a scenario.
pub(super) struct Ground<'a> {
    pub scenario: &'a Scenario,
    /// The demands of coverage that no other implies.
    pub covers: Vec<Demand>,
    /// The plan's tour, then those that some answer was; they may answer the next question too.
    known: Vec<Vec<usize>>,
    /// Iterations for one question.
    most: u64,
}

impl<'a> Ground<'a> {
    /// `tour`: the plan's, as requests; `most`: iterations for one question.
    pub(super) fn new(
        scenario: &'a Scenario,
        covers: Vec<Demand>,
        tour: Vec<usize>,
        most: u64,
    ) -> Self {
        Self { scenario, covers, known: vec![tour], most }
    }

    /// Every constraint: demands first, then deadlines, then the limits of the charger.
    pub(super) fn parts(&self) -> Vec<Part> {
        let mut parts = self.demands();
        parts.extend(self.limits(&parts));
        parts
    }

    /// What must be served.
    pub(super) fn demands(&self) -> Vec<Part> {
        let asks = |i: &usize| {
            let request = &self.scenario.requests[*i];
            request.required && !self.scenario.already_charged(request)
        };
        let required = (0..self.scenario.requests.len()).filter(asks).map(Part::Required);
        (0..self.covers.len()).map(Part::Cover).chain(required).collect()
    }

    /// The deadlines that may matter to these demands, and the limits of the charger.
    pub(super) fn limits(&self, demands: &[Part]) -> Vec<Part> {
        let mut named = vec![!self.is_metric(); self.scenario.requests.len()];
        demands.iter().flat_map(|&part| self.members(part)).for_each(|r| named[r] = true);
        let due = |i: &usize| {
            let request = &self.scenario.requests[*i];
            let candidate = !self.scenario.already_charged(request);
            named[*i] && candidate && request.deadline_s.is_some()
        };
        let mut parts: Vec<Part> = (0..named.len()).filter(due).map(Part::Deadline).collect();
        parts.extend(self.scenario.charger.timespan_s.map(|_| Part::Timespan));
        parts.extend(self.scenario.charger.capacity_j.map(|_| Part::Capacity));
        parts
    }

    /// Whether a stop that nobody asks for never helps.
    fn is_metric(&self) -> bool {
        let moves = |r: &Request| matches!(self.scenario.sensors[r.sensor].place, Place::Moving(_));
        let chases = self.scenario.requests.iter().any(moves);
        self.scenario.travel.is_none() && !(chases && self.scenario.charger.capacity_j.is_some())
    }

    /// The requests that a demand names.
    pub(super) fn members(&self, part: Part) -> Vec<usize> {
        match part {
            Part::Cover(i) => self.covers[i].members.iter().map(|&r| r as usize).collect(),
            Part::Required(request) => vec![request],
            _ => Vec::new(),
        }
    }

    /// Where a demand is.
    pub(super) fn place(&self, part: Part) -> Point {
        match part {
            Part::Cover(i) => self.covers[i].witness,
            Part::Required(request) | Part::Deadline(request) => {
                self.scenario.sensors[self.scenario.requests[request].sensor].place.at(0.0)
            }
            _ => self.scenario.charger.start_m,
        }
    }

    /// Whether a tour keeps these constraints, with all others dropped.
    pub(super) fn decide(&mut self, kept: &[Part], meter: &mut Meter<'_>) -> Answer {
        let scenario = self.relaxed(kept);
        let covers: Vec<Demand> = (kept.iter())
            .filter_map(|part| match part {
                Part::Cover(i) => Some(self.covers[*i].clone()),
                _ => None,
            })
            .collect();
        let instance = Instance::with_demands(&scenario, &covers);
        let keeps = |order: &&Vec<usize>| keeps(&instance, order);
        // Most demands are met by the plan: it answers for them.
        let known = self.known.iter().take(1).chain(self.known.iter().skip(1).rev());
        if let Some(order) = known.take(REMEMBERED).find(keeps) {
            return Answer::Feasible(order.clone());
        }
        let answer = ask(&instance, self.most, meter);
        if let Answer::Feasible(order) = &answer {
            self.known.push(order.clone());
        }
        answer
    }

    /// The scenario without the limits that are not kept, and without coverage, which is asked for apart.
    fn relaxed(&self, kept: &[Part]) -> Scenario {
        let mut scenario = self.scenario.clone();
        scenario.coverage = None;
        let has = |part: Part| kept.contains(&part);
        if !has(Part::Timespan) {
            scenario.charger.timespan_s = None;
        }
        if !has(Part::Capacity) {
            scenario.charger.capacity_j = None;
        }
        let mut required = vec![false; scenario.requests.len()];
        let mut due = required.clone();
        for part in kept {
            match *part {
                Part::Required(request) => required[request] = true,
                Part::Deadline(request) => due[request] = true,
                _ => {}
            }
        }
        for (i, request) in scenario.requests.iter_mut().enumerate() {
            request.required = required[i];
            request.deadline_s = request.deadline_s.filter(|_| due[i]);
        }
        scenario
    }
}

/// Whether the demands that coverage makes of a scenario can be met, whatever the scenario's numbers are now.
pub(super) fn decide_all(
    scenario: &Scenario,
    covers: &[Demand],
    most: u64,
    meter: &mut Meter<'_>,
) -> Answer {
    ask(&Instance::with_demands(scenario, covers), most, meter)
}

/// The demands that coverage makes.
pub(super) fn covers(instance: &Instance<'_>) -> Vec<Demand> {
    coverage::demands(instance.scenario, &instance.regions)
}

fn ask(instance: &Instance<'_>, most: u64, meter: &mut Meter<'_>) -> Answer {
    match meter.decide(instance, most) {
        Verdict::Feasible(order) => Answer::Feasible(
            order.iter().map(|&c| instance.candidates[c as usize].request).collect(),
        ),
        Verdict::Infeasible => Answer::Infeasible,
        Verdict::Unknown => Answer::Unknown,
    }
}

/// Whether a tour keeps what an instance asks; stops that the instance left out do no harm in it.
fn keeps(instance: &Instance<'_>, order: &[usize]) -> bool {
    let candidate = |&request: &usize| {
        instance.candidates.binary_search_by_key(&request, |c| c.request).ok().map(|c| c as u32)
    };
    let order: Vec<u32> = order.iter().filter_map(candidate).collect();
    let tour = Tour::new(instance, &order);
    tour.is_legal() && Value::of(instance, &tour).is_feasible()
}
