//! What a change is said to buy, it buys: the changed document is read, planned and checked anew.

use voltour_solver::check::check;
use voltour_solver::explain::{Buys, Change, Explanation, NextChange, explain};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Document, Objective, Scenario};
use voltour_solver::solvers::plan_from_order;
use voltour_solver::stop::MaxIterations;

use crate::conflicts::{infeasible, plan};
use crate::mixed;

/// The document with what the scenario derived written out, so that a changed deadline changes nothing else.
fn explicit(document: &Document, scenario: &Scenario) -> Document {
    let mut document = document.clone();
    for (written, read) in document.requests.iter_mut().zip(&scenario.requests) {
        written.residual_j = Some(read.residual_j);
        written.reward = Some(read.reward);
    }
    document
}

fn changed(document: &Document, change: &Change, share: f64) -> Scenario {
    let mut document = document.clone();
    let between = |from: f64, to: f64| from + share * (to - from);
    match change {
        Change::Capacity { from_j, to_j } => {
            assert_eq!(document.charger.capacity_j, Some(*from_j));
            document.charger.capacity_j = Some(between(*from_j, *to_j));
        }
        Change::Timespan { from_s, to_s } => {
            assert_eq!(document.charger.timespan_s, Some(*from_s));
            document.charger.timespan_s = Some(between(*from_s, *to_s));
        }
        Change::Speed { from_mps, to_mps } => {
            assert_eq!(document.charger.speed_mps, *from_mps);
            document.charger.speed_mps = between(*from_mps, *to_mps);
        }
        Change::Deadline { sensor, from_s, to_s } => {
            let request = document.requests.iter_mut().find(|r| r.sensor == *sensor).unwrap();
            assert_eq!(request.deadline_s, Some(*from_s));
            request.deadline_s = Some(between(*from_s, *to_s));
        }
    }
    Scenario::from_document(&document).unwrap()
}

/// The plan of the suggested tour in the changed scenario.
fn replanned(scenario: &Scenario, next: &NextChange) -> Plan {
    let request = |id: &String| {
        scenario.requests.iter().position(|r| scenario.sensors[r.sensor].id == *id).unwrap()
    };
    let order: Vec<usize> = next.tour.iter().map(request).collect();
    let plan = plan_from_order(scenario, &order, "auto");
    let broken = check(scenario, &plan);
    assert!(broken.is_empty(), "{:?} {next:?}: {broken:?}", scenario.name);
    plan
}

#[test]
fn what_makes_a_tiny_scenario_feasible_does_and_less_does_not() {
    let (mut told, mut proven) = (0, 0);
    infeasible(400, 4, |document, scenario, plan| {
        let document = explicit(document, scenario);
        let explanation = explain(scenario, plan, 0, &MaxIterations(10_000_000));
        for next in &explanation.next {
            told += 1;
            assert_eq!(next.buys, Buys::Feasible);
            let enough = changed(&document, &next.change, 1.0);
            assert!(replanned(&enough, next).status.is_feasible());
            if next.proven {
                proven += 1;
                let (from, to) = numbers(&next.change);
                let too_little = next.too_little.unwrap();
                assert!(to - too_little <= 0.0101 * to, "{next:?}");
                // A little less than is proven not to do, away from the tolerance.
                let share = (too_little - from) / (to - from) - 1e-3;
                if share > 0.0 {
                    let less = changed(&document, &next.change, share);
                    let best = mixed::oracle(&less);
                    let feasible = best.is_some_and(|w| (w.0, w.1) == (0, 0));
                    assert!(!feasible, "{:?}: {next:?}", scenario.name);
                }
            }
        }
    });
    assert!(told > 300 && proven > 250, "{told} {proven}");
}

fn numbers(change: &Change) -> (f64, f64) {
    match *change {
        Change::Capacity { from_j, to_j } => (from_j, to_j),
        Change::Timespan { from_s, to_s } | Change::Deadline { from_s, to_s, .. } => (from_s, to_s),
        Change::Speed { from_mps, to_mps } => (from_mps, to_mps),
    }
}

#[test]
fn what_betters_a_feasible_plan_does() {
    let mut told = [0; 3];
    for seed in 0..1500 {
        let document = mixed::draw(3 + seed as usize % 6, seed);
        let Ok(scenario) = Scenario::from_document(&document) else { continue };
        let plan = plan(&scenario, 2_000);
        if !plan.status.is_feasible() {
            continue;
        }
        let document = explicit(&document, &scenario);
        let explanation: Explanation = explain(&scenario, &plan, 0, &MaxIterations(20_000));
        for next in &explanation.next {
            let better = replanned(&changed(&document, &next.change, 1.0), next);
            assert!(better.status.is_feasible());
            match (&next.buys, scenario.objective) {
                (Buys::Shorter { from_m, to_m }, Objective::MinDistance) => {
                    assert_eq!(*from_m, plan.distance_m);
                    assert!((better.distance_m - to_m).abs() < 1e-6 && to_m < from_m);
                    told[0] += 1;
                }
                (Buys::Stop { sensor, from, to }, Objective::MaxReward | Objective::MaxCount) => {
                    assert!(next.tour.contains(sensor));
                    assert_eq!(next.tour.len(), plan.stops.len() + 1);
                    assert_eq!(*from, plan.objective);
                    assert!((better.objective - to).abs() < 1e-6 && to > from);
                    told[if scenario.objective == Objective::MaxReward { 1 } else { 2 }] += 1;
                }
                other => panic!("{other:?}"),
            }
        }
    }
    assert!(told[0] > 10 && told[1] > 50 && told[2] > 50, "{told:?}");
}

#[test]
fn no_insertion_needs_less_capacity_or_time() {
    let mut told = 0;
    for seed in 0..1500 {
        let document = mixed::draw(3 + seed as usize % 5, seed);
        let Ok(scenario) = Scenario::from_document(&document) else { continue };
        let plan = plan(&scenario, 2_000);
        if !plan.status.is_feasible() || scenario.objective == Objective::MinDistance {
            continue;
        }
        let explanation = explain(&scenario, &plan, 0, &MaxIterations(20_000));
        let mut document = explicit(&document, &scenario);
        let find = |kind: fn(&Change) -> Option<f64>| {
            explanation.next.iter().find_map(|n| kind(&n.change))
        };
        let capacity =
            find(|c| if let Change::Capacity { to_j, .. } = c { Some(*to_j) } else { None });
        let timespan =
            find(|c| if let Change::Timespan { to_s, .. } = c { Some(*to_s) } else { None });
        let [capacity_j, timespan_s] = [document.charger.capacity_j, document.charger.timespan_s];
        if let Some(to_j) = capacity {
            document.charger.capacity_j = None;
            let least = least(&document, &plan, |p| p.charge_j + p.travel_j);
            assert!((to_j - least).abs() < 1e-6 * to_j, "{:?}: {to_j} {least}", scenario.name);
            document.charger.capacity_j = capacity_j;
            told += 1;
        }
        if let Some(to_s) = timespan {
            document.charger.timespan_s = None;
            let least = least(&document, &plan, |p| p.finish_s);
            assert!((to_s - least).abs() < 1e-6 * to_s, "{:?}: {to_s} {least}", scenario.name);
            document.charger.timespan_s = timespan_s;
            told += 1;
        }
    }
    assert!(told > 100, "{told}");
}

/// The least that any insertion into a plan's tour takes, where the scenario without the limit allows it.
fn least(document: &Document, plan: &Plan, takes: fn(&Plan) -> f64) -> f64 {
    let scenario = Scenario::from_document(document).unwrap();
    let id = |r: usize| &scenario.sensors[scenario.requests[r].sensor].id;
    let request =
        |id: &String| scenario.requests.iter().position(|r| scenario.sensors[r.sensor].id == *id);
    let order: Vec<usize> = plan.stops.iter().map(|s| request(&s.sensor).unwrap()).collect();
    let mut least = f64::INFINITY;
    for new in
        (0..scenario.requests.len()).filter(|&r| plan.unserved.iter().any(|u| u.sensor == *id(r)))
    {
        let asked = &scenario.requests[new];
        let worthless = scenario.objective == Objective::MaxReward && asked.reward == 0.0;
        if worthless || scenario.already_charged(asked) {
            continue;
        }
        for at in 0..=order.len() {
            let mut order = order.clone();
            order.insert(at, new);
            if mixed::worth(&scenario, &order).is_some() {
                least = least.min(takes(&plan_from_order(&scenario, &order, "auto")));
            }
        }
    }
    least
}
