//! Whether any tour is feasible: the verdict against every tour, of scenarios as they are and of
//! parts of their constraints, as explanations ask.

use rand::RngExt;
use voltour_solver::coverage::{Demand, demands, regions};
use voltour_solver::instance::Instance;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::Budget;
use voltour_solver::solvers::exact::{Verdict, decide};
use voltour_solver::stop::MaxIterations;

use crate::draw::{awkward, rng};
use crate::edge::sharpen;
use crate::journey::Journey;
use crate::run::{AMPLE, trials};
use crate::truth::{Need, Truth, candidates, needs};

/// Fails where the verdict is wrong, or missing without an excuse.
fn compare(scenario: &Scenario, instance: &Instance<'_>, needs: &[Need]) -> &'static str {
    let name = &scenario.name;
    let truth = Truth::of(scenario, needs);
    match decide(instance, &mut Budget::new(&MaxIterations(AMPLE))) {
        Verdict::Feasible(order) => {
            let request = |c: &u32| instance.candidates[*c as usize].request;
            let order: Vec<usize> = order.iter().map(request).collect();
            let served = order.iter().fold(0, |set, r| set | 1 << r);
            assert_eq!(u64::count_ones(served) as usize, order.len(), "{name:?}: {order:?}");
            assert!(needs.iter().all(|need| need.is_met(served)), "{name:?}: {order:?}");
            let strain = Journey::along(scenario, &order).strain;
            assert!(strain <= 0.501, "{name:?}: {order:?} exceeds by {strain} tolerances");
            "feasible"
        }
        Verdict::Infeasible => {
            assert!(truth.accepted.is_none(), "{name:?}: infeasible, but {:?}", truth.accepted);
            "infeasible"
        }
        Verdict::Unknown => {
            let certain = truth.kept.is_some() == truth.doubtful.is_some();
            assert!(!certain, "{name:?}: undecided, but {:?}", truth.kept);
            "unknown"
        }
    }
}

#[test]
fn verdicts_about_whole_scenarios_are_true() {
    for seed in 0..trials(1_000) {
        let mut document = awkward(1 + (seed % 6) as usize, 6_000_000 + seed);
        if seed.is_multiple_of(3) {
            sharpen(&mut document, &mut rng(seed));
        }
        let scenario = Scenario::from_document(&document).unwrap();
        compare(&scenario, &Instance::new(&scenario), &needs(&scenario));
    }
}

/// The scenario with some of its limits and `required`, and some of the demands that coverage makes.
fn part(scenario: &Scenario, seed: u64) -> (Scenario, Vec<Demand>) {
    let rng = &mut rng(seed);
    let mut covers = demands(scenario, &regions(scenario));
    covers.retain(|_| rng.random_bool(0.6));
    let mut part = scenario.clone();
    part.coverage = None;
    part.charger.timespan_s = part.charger.timespan_s.filter(|_| rng.random_bool(0.7));
    part.charger.capacity_j = part.charger.capacity_j.filter(|_| rng.random_bool(0.7));
    for request in &mut part.requests {
        request.required &= rng.random_bool(0.6);
        request.deadline_s = request.deadline_s.filter(|_| rng.random_bool(0.7));
    }
    (part, covers)
}

#[test]
fn verdicts_about_some_of_the_constraints_are_true() {
    let mut ends = std::collections::BTreeMap::<_, u64>::new();
    for seed in 0..trials(1_000) {
        let mut document = awkward(1 + (seed % 6) as usize, 7_000_000 + seed);
        if seed.is_multiple_of(3) {
            sharpen(&mut document, &mut rng(seed));
        }
        let scenario = Scenario::from_document(&document).unwrap();
        let (part, covers) = part(&scenario, seed);
        let set = |demand: &Demand| demand.members.iter().fold(0, |set, &r| set | 1 << r);
        let cover = |demand: &Demand| Need { members: set(demand), count: demand.needs };
        let asks = |r: &usize| part.requests[*r].required;
        let required = candidates(&part).into_iter().filter(asks);
        let needs: Vec<Need> = (covers.iter().map(cover))
            .chain(required.map(|r| Need { members: 1 << r, count: 1 }))
            .collect();
        let end = compare(&part, &Instance::with_demands(&part, &covers), &needs);
        *ends.entry(end).or_default() += 1;
    }
    println!("{ends:?}");
}
