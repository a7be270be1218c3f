//! Instances with a known optimum: the frozen ones of this crate, and published ones where there are any.

use std::path::Path;

use voltour_solver::check::check;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::tolerance::agrees;

use crate::run::{AMPLE, exact};

/// The files of `tests/golden` with their optimum, which an enumeration found.
const GOLDEN: [(&str, f64); 11] = [
    ("coverage-6", 1602.4040091482204),
    ("coverage-13", 1005.1308956551946),
    ("reward-0", 24897.260210999997),
    ("reward-1", 27008.946648000005),
    ("mobile-1", 7.0),
    ("mobile-2", 7.0),
    ("mixed-7", 215.77702935500295),
    ("mixed-11", 229.57470766062988),
    ("mixed-20", 406.2721076425302),
    ("mixed-21", 5.0),
    ("mixed-24", 3.0),
];

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
    let mut proven = 0;
    for line in table.lines().skip(1) {
        let mut fields = line.split(',');
        let (name, best) = (fields.next().unwrap(), fields.nth(1).unwrap());
        let best: f64 = best.parse().unwrap();
        let plan = solved(&Path::new(&folder).join(name), 200_000);
        println!("{name}: {:?} {} of {best}, bound {:?}", plan.status, plan.objective, plan.bound);
        proven += usize::from(plan.status == Status::Optimal);
        if plan.status == Status::Optimal {
            assert!(agrees(plan.objective, best), "{name}: {}", plan.objective);
        }
        assert!(plan.status != Status::Infeasible, "{name}");
    }
    println!("{proven} proven");
}
