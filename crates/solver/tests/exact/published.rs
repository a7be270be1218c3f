//! Instances with a known optimum: the frozen ones of this crate, and published ones where there are any.

use std::path::Path;

use voltour_solver::check::check;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::tolerance::agrees;

use crate::golden::GOLDEN;
use crate::run::{AMPLE, exact};

fn solved(path: &Path, iterations: u64) -> Plan {
    let scenario = Scenario::from_json(&std::fs::read(path).unwrap()).unwrap();
    let plan = exact(&scenario, 0, iterations);
    assert_eq!(check(&scenario, &plan), [], "{path:?}");
    plan
}

#[test]
fn golden_scenarios_are_proven() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (name, optimum) in GOLDEN {
        let plan = solved(&folder.join(format!("{name}.json")), AMPLE);
        assert_eq!(plan.status, Status::Optimal, "{name}");
        assert!(agrees(plan.objective, optimum), "{name}: {}", plan.objective);
    }
}

/// Published instances are the work of others and not part of this repository. The folder that
/// `VOLTOUR_BENCHMARKS` names holds them as scenarios, with `best.csv`: file, family, best value, whether
/// that is proven.
#[test]
#[ignore = "needs VOLTOUR_BENCHMARKS, a folder of published instances"]
fn published_instances_are_proven() {
    let folder = std::env::var("VOLTOUR_BENCHMARKS").unwrap();
    let table = std::fs::read_to_string(Path::new(&folder).join("best.csv")).unwrap();
    for line in table.lines().skip(1) {
        let mut fields = line.split(',');
        let (name, best) = (fields.next().unwrap(), fields.nth(1).unwrap());
        let best: f64 = best.parse().unwrap();
        let plan = solved(&Path::new(&folder).join(name), AMPLE);
        assert_eq!(plan.status, Status::Optimal, "{name}");
        assert!(agrees(plan.objective, best), "{name}: {}", plan.objective);
    }
}
