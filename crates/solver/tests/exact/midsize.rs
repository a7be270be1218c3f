//! Scenarios of a size that no enumeration manages, against a plain dynamic programme.

use std::ops::RangeInclusive;

use voltour_solver::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use voltour_solver::plan::Status;
use voltour_solver::scenario::{Document, Objective, Scenario};
use voltour_solver::solvers::Budget;
use voltour_solver::solvers::exact::{Verdict, decide};
use voltour_solver::stop::MaxIterations;

use voltour_solver::check::check;
use voltour_solver::instance::Instance;
use voltour_solver::tolerance::tolerance;

use crate::draw::{Ground, on};
use crate::run::{AMPLE, exact, trials};
use crate::subsets::best;
use crate::truth::{STRAINS, candidates, cost_of, needs};

/// Fails where the exact solver's claim and the programme disagree. Whether it came to a decision.
fn compare(document: &Document) -> bool {
    let scenario = Scenario::from_document(document).unwrap();
    let name = &scenario.name;
    let needs = needs(&scenario);
    let plan = exact(&scenario, 0, AMPLE);
    assert_eq!(check(&scenario, &plan), [], "{name:?}");
    // What is longer than the plan is of no interest where no detour is a short cut.
    let straight = scenario.objective == Objective::MinDistance && scenario.travel.is_none();
    let known = straight && plan.status.is_feasible();
    let most_m = if known { plan.objective + 1e-6 } else { f64::INFINITY };
    let least = best(&scenario, &needs, STRAINS[1], most_m);
    let claim = plan.bound.map(|bound| cost_of(&scenario, bound) - 1.001 * tolerance(bound));
    match (plan.status, least) {
        (Status::Infeasible, least) => assert!(least.is_none(), "{name:?}: {least:?}"),
        (Status::BestEffort, _) => {}
        (_, None) => panic!("{name:?}: none is feasible, but {:?}", plan.stops),
        (..) => {}
    }
    if let (Some(least), Some(claim)) = (least, claim) {
        assert!(claim <= least, "{name:?}: bound {:?}, but {least}", plan.bound);
    }
    match decide(&Instance::new(&scenario), &mut Budget::new(&MaxIterations(AMPLE))) {
        Verdict::Feasible(_) => assert!(least.is_some(), "{name:?}"),
        Verdict::Infeasible => assert!(least.is_none(), "{name:?}: {least:?}"),
        Verdict::Unknown => {}
    }
    matches!(plan.status, Status::Optimal | Status::Infeasible)
}

/// The share of these that the solver decides must be at least nine tenths.
fn compare_all(documents: impl IntoIterator<Item = Document>) {
    let decided: Vec<bool> = documents.into_iter().map(|document| compare(&document)).collect();
    let open = decided.iter().filter(|decided| !**decided).count();
    assert!(!decided.is_empty() && 10 * open <= decided.len(), "{open} open");
}

/// The first scenarios of k-coverage with so many candidates, in which somebody must be charged.
fn coverage(sizes: RangeInclusive<usize>, count: u64) -> impl Iterator<Item = Document> {
    let options = KCoverage { sensors: 32, k: 2, alpha: 0.5, ..KCoverage::default() };
    let sized = move |document: &Document| {
        let scenario = Scenario::from_document(document).unwrap();
        sizes.contains(&candidates(&scenario).len()) && !needs(&scenario).is_empty()
    };
    let drawn = (0..).map(move |seed| k_coverage(&options, seed).unwrap());
    drawn.filter(sized).take(count as usize)
}

#[test]
fn coverage_of_ten_to_fourteen_candidates() {
    compare_all(coverage(10..=14, trials(12)));
}

#[test]
fn coverage_of_fifteen_and_sixteen_candidates() {
    compare_all(coverage(15..=16, trials(3)));
}

#[test]
fn rewards_of_twelve_candidates() {
    let documents = (0..trials(30)).map(|seed| {
        let capacity_j = 150e3 + 1e4 * (seed % 10) as f64;
        let options = Reward { sensors: 12, alpha: 1.0, capacity_j, ..Reward::default() };
        reward(&options, seed).unwrap()
    });
    compare_all(documents);
}

#[test]
fn mobile_networks_of_ten_candidates() {
    let documents = (0..trials(20)).map(|seed| {
        let options = Mobile { sensors: 12, ..Mobile::default() };
        let mut document = mobile(&options, seed).unwrap();
        document.requests.truncate(10);
        document.charger.timespan_s = Some(300.0 + 60.0 * (seed % 10) as f64);
        document
    });
    compare_all(documents);
}

#[test]
fn awkward_scenarios_of_eight_to_ten_requests() {
    use Ground::{Lattice, Plane, RealMatrix, SymmetricMatrix, WholeMatrix};
    let grounds = [Plane, Lattice, RealMatrix, WholeMatrix, SymmetricMatrix];
    let documents = (0..trials(150))
        .map(|seed| on(grounds[seed as usize % 5], 8 + (seed % 3) as usize, 8_000_000 + seed));
    compare_all(documents);
}

#[test]
fn awkward_scenarios_with_sensors_that_move() {
    let documents = (0..trials(40)).map(|seed| {
        let mut document = on(Ground::Moving, 7 + (seed % 3) as usize, 9_000_000 + seed);
        // Time alone decides.
        document.charger.capacity_j = None;
        if document.objective == Objective::MinDistance {
            document.objective = Objective::MaxCount;
        }
        document
    });
    compare_all(documents);
}
