//! What is true of a scenario, found by trying every tour, and whether a plan's claims agree with it.

use voltour_solver::check::check;
use voltour_solver::coverage::regions;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::{Objective, Scenario};
use voltour_solver::tolerance::tolerance;

use crate::journey::Journey;

/// At least so many of these requests, a set of bits, must be served.
#[derive(Clone, Copy, Debug)]
pub struct Need {
    pub members: u64,
    pub count: u32,
}

impl Need {
    pub fn is_met(&self, served: u64) -> bool {
        (self.members & served).count_ones() >= self.count
    }
}

/// What the constraints 4 and 5 ask of the set of served requests.
pub fn needs(scenario: &Scenario) -> Vec<Need> {
    let candidates = candidates(scenario);
    let required = candidates.iter().filter(|&&r| scenario.requests[r].required);
    let mut needs: Vec<Need> = required.map(|&r| Need { members: 1 << r, count: 1 }).collect();
    let Some(coverage) = &scenario.coverage else { return needs };
    for region in regions(scenario) {
        let covers = |r: &&usize| region.covering.contains(&(scenario.requests[**r].sensor as u32));
        let members = candidates.iter().filter(covers).fold(0, |set, &r| set | 1 << r);
        let all = region.covering.len() as u32;
        let kept = all - u64::count_ones(members);
        let count = all.min(coverage.k).saturating_sub(kept);
        if count > 0 {
            needs.push(Need { members, count });
        }
    }
    needs
}

/// The requests that are not already charged.
pub fn candidates(scenario: &Scenario) -> Vec<usize> {
    let open = |&r: &usize| !scenario.already_charged(&scenario.requests[r]);
    (0..scenario.requests.len()).filter(open).collect()
}

/// An objective as a cost: smaller is better.
pub fn cost_of(scenario: &Scenario, objective: f64) -> f64 {
    if scenario.objective == Objective::MinDistance { objective } else { -objective }
}

/// The cost of a tour.
pub fn cost(scenario: &Scenario, length_m: f64, served: u64) -> f64 {
    let rewards = scenario.requests.iter().enumerate().filter(|(r, _)| served >> r & 1 == 1);
    match scenario.objective {
        Objective::MinDistance => length_m,
        Objective::MaxReward => -rewards.map(|(_, request)| request.reward).sum::<f64>(),
        Objective::MaxCount => -f64::from(served.count_ones()),
    }
}

/// A tour that no other of its kind beats.
#[derive(Clone, Debug)]
pub struct Best {
    pub cost: f64,
    pub order: Vec<usize>,
}

/// The best feasible tours under limits of different width. Half a thousandth of a tolerance is
/// left to rounding.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Of those that a solver allows itself for sure.
    pub kept: Option<Best>,
    /// Of those that the check accepts for sure.
    pub accepted: Option<Best>,
    /// Of those that the check might accept.
    pub doubtful: Option<Best>,
}

/// Strains up to which a tour is kept, accepted and doubtful.
pub const STRAINS: [f64; 3] = [0.499, 0.999, 1.002];

impl Truth {
    /// Tries every order of every subset.
    pub fn of(scenario: &Scenario, needs: &[Need]) -> Self {
        let mut truth = Self::default();
        let candidates = candidates(scenario);
        let begin = Journey::begin(scenario);
        truth.extend(scenario, &candidates, needs, &begin, &mut Vec::new(), 0);
        truth
    }

    fn extend(
        &mut self,
        scenario: &Scenario,
        candidates: &[usize],
        needs: &[Need],
        at: &Journey,
        order: &mut Vec<usize>,
        served: u64,
    ) {
        if needs.iter().all(|need| need.is_met(served)) {
            let home = at.home(scenario);
            self.offer(&home, cost(scenario, home.length_m, served), order);
        }
        for &next in candidates.iter().filter(|&&next| served >> next & 1 == 0) {
            let ahead = at.visit(scenario, next);
            // A deadline that was missed stays missed.
            if ahead.strain <= STRAINS[2] {
                order.push(next);
                self.extend(scenario, candidates, needs, &ahead, order, served | 1 << next);
                order.pop();
            }
        }
    }

    fn offer(&mut self, home: &Journey, cost: f64, order: &[usize]) {
        let kinds = [&mut self.kept, &mut self.accepted, &mut self.doubtful];
        for (best, most) in kinds.into_iter().zip(STRAINS) {
            if home.strain <= most && best.as_ref().is_none_or(|best| cost < best.cost) {
                *best = Some(Best { cost, order: order.to_vec() });
            }
        }
    }

    /// Whether no tolerance matters, so that whoever has the time must come to a decision.
    pub fn is_clear(&self) -> bool {
        match (&self.kept, &self.doubtful) {
            (Some(kept), Some(doubtful)) => {
                kept.cost - doubtful.cost <= 1e-9 * (1.0 + kept.cost.abs())
            }
            (kept, doubtful) => kept.is_none() && doubtful.is_none(),
        }
    }

    /// Fails where a plan does not hold, or claims what some tour refutes.
    pub fn assert_bears_out(&self, scenario: &Scenario, plan: &Plan) {
        let name = &scenario.name;
        let broken = check(scenario, plan);
        assert!(broken.is_empty(), "{name:?}: {broken:?}");
        let accepted = self.accepted.as_ref();
        if plan.status == Status::Infeasible {
            assert!(accepted.is_none(), "{name:?}: infeasible, but {accepted:?}");
        }
        if plan.status.is_feasible() {
            assert!(accepted.is_some(), "{name:?}: no tour is feasible, but {:?}", plan.stops);
        }
        if plan.status == Status::Optimal {
            self.assert_none_beats(scenario, plan.objective);
        }
        if let Some(bound) = plan.bound {
            self.assert_none_beats(scenario, bound);
        }
    }

    /// Fails where a tour is better than `claim`, a value of the objective, by more than the tolerance.
    fn assert_none_beats(&self, scenario: &Scenario, claim: f64) {
        if let Some(best) = &self.accepted {
            let least = cost_of(scenario, claim) - 1.001 * tolerance(claim);
            assert!(best.cost >= least, "{:?}: {claim} is beaten by {best:?}", scenario.name);
        }
    }
}
