//! Planning a changed scenario with a few iterations.

use std::collections::HashMap;

use super::meter::Meter;
use crate::plan::Plan;
use crate::scenario::{Request, Scenario};
use crate::solvers::{Options, SolverName, solve};

/// Iterations of one planning.
const ITERATIONS: u64 = 300;

/// The plan of a scenario; `None` where the stop rule came first.
pub(super) fn plan_of(scenario: &Scenario, seed: u64, meter: &mut Meter<'_>) -> Option<Plan> {
    if !meter.spend() {
        return None;
    }
    let solved = meter.lend(ITERATIONS, |stop| {
        solve(scenario, &Options { solver: SolverName::Auto, seed, stop, policy: None })
    });
    solved.ok().map(|outcome| outcome.plan)
}

/// The tour of a feasible plan of a scenario, as requests.
pub(super) fn order_of(
    scenario: &Scenario,
    seed: u64,
    meter: &mut Meter<'_>,
) -> Option<Vec<usize>> {
    let plan = plan_of(scenario, seed, meter).filter(|plan| plan.status.is_feasible())?;
    Some(requests(scenario, &plan))
}

/// The stops of a plan as requests; what is no request of the scenario is left out.
pub(super) fn requests(scenario: &Scenario, plan: &Plan) -> Vec<usize> {
    let id = |r: &Request| scenario.sensors[r.sensor].id.as_str();
    let asking: HashMap<&str, usize> =
        scenario.requests.iter().enumerate().map(|(i, r)| (id(r), i)).collect();
    plan.stops.iter().filter_map(|stop| asking.get(stop.sensor.as_str()).copied()).collect()
}
