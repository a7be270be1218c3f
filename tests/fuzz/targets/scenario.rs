//! A scenario document: read, or refused in a sentence. One that is read can be planned, and the plan holds.

use voltour_solver::check::check;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, SolverName, solve};
use voltour_solver::stop::MaxIterations;

/// Larger ones are read and not planned: time is for many documents.
const SENSORS: usize = 12;

pub fn scenario(data: &[u8]) -> bool {
    let scenario = match Scenario::from_json(data) {
        Ok(scenario) => scenario,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return false;
        }
    };
    if scenario.sensors.len() <= SENSORS {
        let stop = MaxIterations(20);
        let options = Options { solver: SolverName::Baseline, seed: 0, stop: &stop, policy: None };
        // A solver may say that a scenario is not for it; a tour that breaks a rule is a defect.
        if let Ok(solved) = solve(&scenario, &options) {
            let broken = check(&scenario, &solved.plan);
            assert!(broken.is_empty(), "{broken:?}");
        }
    }
    true
}
