//! How these tests run a solver, and how often.

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::{Document, Scenario};
use voltour_solver::solvers::{
    Options, Outcome, PaperOptions, SolverName, Unavailable, solve_with,
};
use voltour_solver::stop::MaxIterations;

/// More than small scenarios need.
pub const AMPLE: u64 = 10_000_000;

/// What a solver says; its plan holds.
pub fn attempt(
    scenario: &Scenario,
    solver: SolverName,
    paper: &PaperOptions,
    iterations: u64,
) -> Result<Outcome, Unavailable> {
    let options = Options { solver, seed: 7, stop: &MaxIterations(iterations), policy: None };
    let outcome = solve_with(&Instance::new(scenario), &options, paper)?;
    let broken = check(scenario, &outcome.plan);
    assert!(broken.is_empty(), "{:?} {solver}: {broken:?}", scenario.name);
    Ok(outcome)
}

/// The plan of a solver that comes to its end.
pub fn plan(scenario: &Scenario, solver: SolverName, paper: &PaperOptions) -> Plan {
    let outcome = attempt(scenario, solver, paper, AMPLE).unwrap();
    assert_eq!(outcome.unfinished, None, "{:?} {solver}", scenario.name);
    outcome.plan
}

/// The proven optimum; `None` where there is no feasible tour.
pub fn optimum(scenario: &Scenario) -> Option<Plan> {
    let plan = attempt(scenario, SolverName::Exact, &PaperOptions::default(), AMPLE).unwrap().plan;
    match plan.status {
        Status::Optimal => Some(plan),
        Status::Infeasible => None,
        status => panic!("{:?}: {} is no proof", scenario.name, status.name()),
    }
}

/// The requests of a plan's stops, in order.
pub fn order(scenario: &Scenario, plan: &Plan) -> Vec<usize> {
    let request = |id: &String| {
        scenario.requests.iter().position(|r| &scenario.sensors[r.sensor].id == id).unwrap()
    };
    plan.stops.iter().map(|stop| request(&stop.sensor)).collect()
}

/// The ids of a plan's stops, in order.
pub fn ids(plan: &Plan) -> Vec<&str> {
    plan.stops.iter().map(|stop| stop.sensor.as_str()).collect()
}

pub fn parsed(document: &Document) -> Scenario {
    Scenario::from_document(document).unwrap()
}

/// The trials of a test that has so many by default, scaled as `VOLTOUR_TRIALS` asks.
pub fn trials(default: u64) -> u64 {
    const LARGEST: u64 = 1_500;
    let asked = std::env::var("VOLTOUR_TRIALS").map_or(LARGEST, |text| text.parse().unwrap());
    (default * asked).div_ceil(LARGEST)
}
