//! [`explain`]: the questions in their order, facts first, then what takes a search.

use super::change::NextChange;
use super::conflict::{self, Search};
use super::explanation::{Clause, Conflict, Explanation, FORMAT};
use super::facts::alone;
use super::ground::{Ground, Part, covers};
use super::insertion::Present;
use super::meter::Meter;
use super::{next, planning, sentence, stops};
use crate::instance::Instance;
use crate::plan::{Plan, Status};
use crate::scenario::{Objective, Scenario};
use crate::stop::StopRule;

/// Iterations for one question of the search for a conflict.
const DECISION: u64 = 200_000;

/// Explains a plan of a scenario. Same scenario, plan, seed and number of iterations: same explanation. The
/// plan is believed; `check` is for those that are not.
pub fn explain(scenario: &Scenario, plan: &Plan, seed: u64, stop: &dyn StopRule) -> Explanation {
    let mut meter = Meter::new(stop);
    let instance = Instance::new(scenario);
    let covers = covers(&instance);
    let mut present = Present::new(&instance, present_order(&instance, plan));
    let served = stops::served(&present, &covers);
    let (unserved, tried) = stops::unserved(&mut present, plan, &mut meter);
    let mut explanation = Explanation {
        format: FORMAT.to_owned(),
        scenario: scenario.name.clone(),
        status: plan.status,
        objective: scenario.objective,
        conflict: None,
        feasible_tour: None,
        unserved,
        served,
        next: Vec::new(),
        complete: true,
        iterations: 0,
    };
    if !plan.status.is_feasible() {
        let mut ground =
            Ground::new(scenario, covers, planning::requests(scenario, plan), DECISION);
        explain_infeasible(&mut explanation, &mut ground, &instance, plan, seed, &mut meter);
    } else if scenario.objective == Objective::MinDistance {
        explanation.next = next::shorter(scenario, plan, seed, &mut meter);
    } else {
        explanation.next = next::one_more(&present, plan, &tried);
    }
    explanation.complete = !meter.is_cut();
    explanation.iterations = meter.iterations();
    explanation
}

/// The plan's stops as candidates.
fn present_order(instance: &Instance<'_>, plan: &Plan) -> Vec<u32> {
    let requests = planning::requests(instance.scenario, plan);
    let candidate = |request: usize| instance.candidates.iter().position(|c| c.request == request);
    requests.into_iter().filter_map(candidate).map(|c| c as u32).collect()
}

fn explain_infeasible(
    explanation: &mut Explanation,
    ground: &mut Ground<'_>,
    instance: &Instance<'_>,
    plan: &Plan,
    seed: u64,
    meter: &mut Meter<'_>,
) {
    let parts = match conflict::search(ground, plan, meter) {
        Search::Conflict(parts, irreducible) => {
            explanation.status = Status::Infeasible;
            explanation.conflict = Some(told(ground, instance, &parts, irreducible));
            Some(parts)
        }
        Search::Tour(order) => {
            let id =
                |&r: &usize| ground.scenario.sensors[ground.scenario.requests[r].sensor].id.clone();
            explanation.feasible_tour = Some(order.iter().map(id).collect());
            return;
        }
        Search::Open => {
            meter.cut();
            None
        }
    };
    explanation.next = changes(ground, parts.as_deref(), instance, plan, seed, meter);
}

fn changes(
    ground: &Ground<'_>,
    conflict: Option<&[Part]>,
    instance: &Instance<'_>,
    plan: &Plan,
    seed: u64,
    meter: &mut Meter<'_>,
) -> Vec<NextChange> {
    let tour = crate::tour::Tour::new(instance, &present_order(instance, plan));
    // Whose service would mend something, where no conflict says whom to look at.
    let mends = |part: &Part| ground.members(*part);
    let mut suspects: Vec<usize> = ground.demands().iter().flat_map(mends).collect();
    suspects.sort_unstable();
    suspects.dedup();
    let unserved = |request: &usize| {
        let candidate = instance.candidates.binary_search_by_key(request, |c| c.request);
        candidate.is_ok_and(|c| !tour.serves(c as u32))
    };
    suspects.retain(unserved);
    next::feasible(ground.scenario, &ground.covers, conflict, &suspects, seed, meter)
}

/// The conflict with its words.
fn told(
    ground: &Ground<'_>,
    instance: &Instance<'_>,
    parts: &[Part],
    irreducible: bool,
) -> Conflict {
    let scenario = ground.scenario;
    let id = |request: usize| scenario.sensors[scenario.requests[request].sensor].id.clone();
    let clause = |part: &Part| match *part {
        Part::Cover(i) => {
            let demand = &ground.covers[i];
            Some(Clause::Demand {
                at_m: [demand.witness.x, demand.witness.y],
                needs: demand.needs,
                members: demand.members.iter().map(|&r| id(r as usize)).collect(),
            })
        }
        Part::Required(request) => Some(Clause::Required { sensor: id(request) }),
        Part::Deadline(request) => {
            let deadline_s = scenario.requests[request].deadline_s?;
            Some(Clause::Deadline { sensor: id(request), deadline_s })
        }
        Part::Capacity => {
            scenario.charger.capacity_j.map(|capacity_j| Clause::Capacity { capacity_j })
        }
        Part::Timespan => {
            scenario.charger.timespan_s.map(|timespan_s| Clause::Timespan { timespan_s })
        }
    };
    let mut parts = parts.to_vec();
    parts.sort_unstable();
    let mut members: Vec<usize> = parts.iter().flat_map(|&part| ground.members(part)).collect();
    members.sort_unstable();
    members.dedup();
    let candidate =
        |request: &usize| instance.candidates.binary_search_by_key(request, |c| c.request);
    let alone = members.iter().filter_map(|r| candidate(r).ok()).map(|c| alone(instance, c as u32));
    let clauses: Vec<Clause> = parts.iter().filter_map(clause).collect();
    let alone: Vec<_> = alone.collect();
    let sentence = sentence::of(&clauses, &alone, instance);
    Conflict { clauses, irreducible, sentence, alone }
}
