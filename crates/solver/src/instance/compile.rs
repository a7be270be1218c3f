//! [`Instance`]: compiled once per solve; borrows the scenario it was made of.

use std::sync::Arc;

use super::{Candidate, DemandSet, Travel, earliest};
use crate::coverage::{self, Region};
use crate::scenario::{Objective, Place, Point, Scenario};
use crate::tolerance::{solver_limit, tolerance};
use crate::tour::Run;

/// What an insertion or an order costs in the resource that the instance is short of.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Per metre travelled.
    pub per_m: f64,
    /// Per second by which the tour is delayed.
    pub per_s: f64,
    /// Per joule delivered.
    pub per_j: f64,
}

/// A scenario as a search sees it.
#[derive(Clone, Debug)]
pub struct Instance<'a> {
    /// What it was made of.
    pub scenario: &'a Scenario,
    /// By index; all other indices refer to these.
    pub candidates: Vec<Candidate>,
    /// Distances where nothing moves.
    pub travel: Arc<Travel>,
    /// The distinct covering sets, for the plan.
    pub regions: Vec<Region>,
    /// The demands that no other implies.
    pub demands: DemandSet,
    /// The demands as violations count them.
    pub all_demands: DemandSet,
    /// Latest arrival at the end that a solver allows itself, in seconds; infinite if free.
    pub timespan_s: f64,
    /// Largest energy that a solver allows itself, in joules; infinite if free.
    pub capacity_j: f64,
    /// What a solver spends sparingly.
    pub effort: Effort,
    /// Seconds that a metre takes. Searches multiply by it: a division takes several times as long.
    pub travel_spm: f64,
    /// Seconds that delivering a joule takes.
    pub transfer_spj: f64,
    /// Some candidate moves: only forward simulation is right.
    pub moving: bool,
    /// Distances are Euclidean between places at rest: leaving a stop out never breaks a limit.
    pub metric: bool,
    /// Every distance is the same both ways.
    pub symmetric: bool,
    /// Segments concatenate (`design.md`): nothing moves, no charge saturates, and energy is affine in
    /// the start.
    pub segments: bool,
    /// Some candidate has a ready time.
    pub waits: bool,
    /// Legality hangs on totals alone: no deadline, ready time or drain.
    pub untimed: bool,
}

impl<'a> Instance<'a> {
    /// Compiles a scenario.
    pub fn new(scenario: &'a Scenario) -> Self {
        let candidates = Self::asking(scenario);
        let regions = coverage::regions(scenario);
        let demands = DemandSet::reduced(scenario, &regions, &candidates);
        let all_demands = DemandSet::complete(scenario, &regions, &candidates);
        Self::compile(scenario, candidates, regions, demands, all_demands)
    }

    /// Compiles a scenario with these demands in place of those that its coverage makes: for a question of
    /// feasibility alone, asked many times with some of the demands. Candidates that neither a demand
    /// nor `required` names are left out wherever doing without a stop never breaks a limit, so that a
    /// local question is a small one; there are no regions.
    pub fn with_demands(scenario: &'a Scenario, demands: &[coverage::Demand]) -> Self {
        let mut candidates = Self::asking(scenario);
        let mut named: Vec<bool> = scenario.requests.iter().map(|r| r.required).collect();
        demands.iter().flat_map(|d| &d.members).for_each(|&r| named[r as usize] = true);
        let named = |c: &Candidate| named[c.request];
        // A faster charger is never later for leaving a stop out; but where it meets a moving sensor
        // earlier, its way may be longer, and only energy counts metres.
        let chases = candidates.iter().any(|c| named(c) && Self::moves(scenario, c));
        if scenario.travel.is_none() && !(chases && scenario.charger.capacity_j.is_some()) {
            candidates.retain(named);
        }
        let set = DemandSet::over_requests(scenario, demands, &candidates);
        Self::compile(scenario, candidates, Vec::new(), set.clone(), set)
    }

    /// The requests that are not already charged.
    fn asking(scenario: &Scenario) -> Vec<Candidate> {
        let asking = scenario.requests.iter().enumerate();
        asking
            .filter(|(_, request)| !scenario.already_charged(request))
            .map(|(index, request)| Candidate::new(scenario, index, request))
            .collect()
    }

    fn moves(scenario: &Scenario, candidate: &Candidate) -> bool {
        let sensor = scenario.requests[candidate.request].sensor;
        matches!(scenario.sensors[sensor].place, Place::Moving(_))
    }

    fn compile(
        scenario: &'a Scenario,
        candidates: Vec<Candidate>,
        regions: Vec<Region>,
        demands: DemandSet,
        all_demands: DemandSet,
    ) -> Self {
        let charger = &scenario.charger;
        let moving = candidates.iter().any(|c| Self::moves(scenario, c));
        let timespan_s = charger.timespan_s.map_or(f64::INFINITY, solver_limit);
        let drains = candidates.iter().any(|c| c.drain_w > 0.0);
        let waits = candidates.iter().any(|c| c.ready_s > 0.0);
        // Within the tolerance of its deadline, and the rounding of a document's numbers, a sensor may just
        // have run empty: that is no break point.
        let saturates = |c: &Candidate| {
            c.due_s.min(timespan_s) > solver_limit(c.empty_s()) + tolerance(c.empty_s())
        };
        let affine_energy = charger.capacity_j.is_none() || !drains || !waits;
        let travel = Travel::new(scenario, &candidates);
        Self {
            symmetric: scenario.travel.is_none() || travel.is_symmetric(),
            travel: Arc::new(travel),
            demands,
            all_demands,
            regions,
            timespan_s,
            capacity_j: charger.capacity_j.map_or(f64::INFINITY, solver_limit),
            effort: Self::scarce(scenario),
            travel_spm: 1.0 / charger.speed_mps,
            transfer_spj: 1.0 / charger.transfer_w,
            moving,
            metric: !moving && scenario.travel.is_none(),
            segments: !moving && affine_energy && !candidates.iter().any(saturates),
            waits,
            untimed: !moving
                && !waits
                && !drains
                && candidates.iter().all(|c| c.due_s.is_infinite()),
            candidates,
            scenario,
        }
    }

    /// The share of each limit that a metre, a second and a joule use up.
    fn scarce(scenario: &Scenario) -> Effort {
        let charger = &scenario.charger;
        if scenario.objective == Objective::MinDistance {
            return Effort { per_m: 1.0, per_s: 0.0, per_j: 0.0 };
        }
        let share = |limit: Option<f64>| limit.map_or(0.0, |limit| 1.0 / limit.max(1e-9));
        let per_j = share(charger.capacity_j);
        let mut per_s = share(charger.timespan_s);
        if per_j == 0.0 && per_s == 0.0 {
            per_s = 1.0;
        }
        // The tie-break, and a preference where waiting makes time free.
        let tie = 1e-3 * (per_s / charger.speed_mps + per_j * charger.travel_jpm);
        Effort { per_m: per_j * charger.travel_jpm + tie, per_s, per_j }
    }

    /// The effort that counts only what breaks ties.
    pub fn tie_effort(&self) -> Effort {
        match self.scenario.objective {
            Objective::MinDistance => self.effort,
            Objective::MaxReward => Effort { per_m: 1.0, per_s: 0.0, per_j: 0.0 },
            Objective::MaxCount => Effort { per_m: 0.0, per_s: 1.0, per_j: 0.0 },
        }
    }

    /// Number of candidates.
    pub fn len(&self) -> usize {
        self.candidates.len()
    }

    /// Whether there is nobody to charge.
    pub fn is_empty(&self) -> bool {
        self.candidates.is_empty()
    }

    /// The place from which the charger leaves, as an index of [`Travel`].
    pub fn start(&self) -> usize {
        self.candidates.len()
    }

    /// The place where the tour must end, as an index of [`Travel`].
    pub fn end(&self) -> usize {
        self.candidates.len() + 1
    }

    /// Distance between two places at rest, in metres.
    #[inline]
    pub fn distance_m(&self, from: usize, to: usize) -> f64 {
        self.travel.distance_m(from, to)
    }

    /// The charger at its start, at time 0.
    pub fn departure(&self) -> Run {
        Run {
            node: self.start() as u32,
            place: self.scenario.charger.start_m,
            arrive_s: 0.0,
            depart_s: 0.0,
            distance_m: 0.0,
            charge_j: 0.0,
        }
    }

    /// Where a candidate is at a time, in seconds.
    pub fn point_at(&self, candidate: u32, time_s: f64) -> Point {
        let request = self.candidates[candidate as usize].request;
        self.scenario.sensors[self.scenario.requests[request].sensor].place.at(time_s)
    }

    /// Goes on to candidate `to` and charges it; its deadline is not looked at.
    // Every search spends its time in loops over this, and where nothing moves a call costs as much as the step:
    // it is compiled into them, and the chase of a moving sensor is left outside.
    #[inline(always)]
    pub fn step(&self, run: &Run, to: u32) -> Run {
        let candidate = &self.candidates[to as usize];
        let (arrive_s, leg_m, place) = if self.moving {
            self.meet(run, candidate)
        } else {
            let leg_m = self.distance_m(run.node as usize, to as usize);
            let arrive_s = run.depart_s + leg_m * self.travel_spm;
            (candidate.ready_s.max(arrive_s), leg_m, candidate.point)
        };
        let charge_j = candidate.charge_j(arrive_s);
        Run {
            node: to,
            place,
            arrive_s,
            depart_s: arrive_s + charge_j * self.transfer_spj,
            distance_m: run.distance_m + leg_m,
            charge_j: run.charge_j + charge_j,
        }
    }

    #[inline(never)]
    fn meet(&self, run: &Run, candidate: &Candidate) -> (f64, f64, crate::scenario::Point) {
        let speed = self.scenario.charger.speed_mps;
        let sensor = self.scenario.requests[candidate.request].sensor;
        match &self.scenario.sensors[sensor].place {
            Place::Fixed(point) => {
                let leg_m = (point - run.place).norm();
                (candidate.ready_s.max(run.depart_s + leg_m / speed), leg_m, *point)
            }
            Place::Moving(trajectory) => {
                let not_before = candidate.ready_s.max(run.depart_s);
                let (arrive_s, place) =
                    earliest(trajectory, run.place, run.depart_s, not_before, speed);
                (arrive_s, (place - run.place).norm(), place)
            }
        }
    }

    /// Goes on to the end of the tour.
    #[inline]
    pub fn finish(&self, run: &Run) -> Run {
        let leg_m = if self.moving {
            (self.scenario.charger.end_m - run.place).norm()
        } else {
            self.distance_m(run.node as usize, self.end())
        };
        let arrive_s = run.depart_s + leg_m * self.travel_spm;
        Run {
            node: self.end() as u32,
            place: self.scenario.charger.end_m,
            arrive_s,
            depart_s: arrive_s,
            distance_m: run.distance_m + leg_m,
            charge_j: run.charge_j,
        }
    }

    /// Energy travelled and delivered so far, in joules.
    pub fn energy_j(&self, run: &Run) -> f64 {
        run.charge_j + self.scenario.charger.travel_jpm * run.distance_m
    }

    /// Whether charging began in time at the candidate that `run` stands at.
    #[inline]
    pub fn in_time(&self, run: &Run) -> bool {
        run.arrive_s <= self.candidates[run.node as usize].due_s
    }

    /// Whether a finished run keeps the time span and the capacity.
    pub fn keeps_limits(&self, finished: &Run) -> bool {
        finished.arrive_s <= self.timespan_s && self.energy_j(finished) <= self.capacity_j
    }
}
