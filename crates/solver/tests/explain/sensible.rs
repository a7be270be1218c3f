//! Plans and scenarios of every kind get an explanation that adds up.

use voltour_solver::explain::{Breach, WhyUnserved, explain};
use voltour_solver::plan::{Reason, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{empty_plan, plan_from_order};
use voltour_solver::stop::MaxIterations;
use voltour_solver::tolerance::agrees;

use crate::conflicts::plan;
use crate::mixed;

fn scenario(text: &str) -> Scenario {
    Scenario::from_json(text.as_bytes()).unwrap()
}

const BARE: &str = r#"{
  "format": "voltour/scenario/1", "objective": "max_count",
  "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
  "sensors": [], "requests": []
}"#;

#[test]
fn a_scenario_without_requests() {
    let scenario = scenario(BARE);
    let explanation = explain(&scenario, &empty_plan(&scenario), 0, &MaxIterations(10));
    assert!(explanation.complete && explanation.status == Status::Feasible);
    assert_eq!(explanation.to_string(), "feasible: the tour keeps every constraint.\n");
}

#[test]
fn an_empty_trip_over_both_limits_has_one_of_them_in_its_conflict() {
    let text = BARE
        .replace("\"start_m\": [0, 0]", "\"start_m\": [0, 0], \"end_m\": [90, 0]")
        .replace("\"transfer_w\": 10", "\"transfer_w\": 10, \"capacity_j\": 1, \"timespan_s\": 1");
    let scenario = scenario(&text);
    let explanation = explain(&scenario, &empty_plan(&scenario), 0, &MaxIterations(100));
    let conflict = explanation.conflict.unwrap();
    assert!(conflict.irreducible && conflict.clauses.len() == 1);
    assert!(conflict.sentence.starts_with("Even without a stop"), "{}", conflict.sentence);
    // Either change alone leaves the other limit broken.
    assert!(explanation.next.is_empty() && explanation.complete);
}

#[test]
fn a_poor_plan_of_a_feasible_scenario_is_told_that_a_tour_exists() {
    let mut told = 0;
    for seed in 0..400 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(5, seed)) else { continue };
        let empty = empty_plan(&scenario);
        if empty.status.is_feasible() || !plan(&scenario, 100_000).status.is_feasible() {
            continue;
        }
        let explanation = explain(&scenario, &empty, 0, &MaxIterations(1_000_000));
        assert!(explanation.conflict.is_none() && explanation.next.is_empty());
        let tour = explanation.feasible_tour.unwrap();
        let asks = |id: &String| {
            scenario.requests.iter().position(|r| scenario.sensors[r.sensor].id == *id).unwrap()
        };
        let order: Vec<usize> = tour.iter().map(asks).collect();
        assert!(plan_from_order(&scenario, &order, "auto").status.is_feasible());
        told += 1;
    }
    assert!(told > 30, "{told}");
}

#[test]
fn insertions_add_up() {
    for seed in 0..600 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(6, seed)) else { continue };
        let plan = plan(&scenario, 60);
        let explanation = explain(&scenario, &plan, 0, &MaxIterations(100_000));
        let reasons = |u: &WhyUnserved| (u.sensor.clone(), u.reason);
        let expected: Vec<_> = plan.unserved.iter().map(|u| (u.sensor.clone(), u.reason)).collect();
        assert_eq!(explanation.unserved.iter().map(reasons).collect::<Vec<_>>(), expected);
        for why in &explanation.unserved {
            insertion_adds_up(&scenario, &plan, why);
        }
        let ids = |s: &voltour_solver::plan::Stop| s.sensor.clone();
        let stops: Vec<String> = plan.stops.iter().map(ids).collect();
        assert!(explanation.served.iter().map(|s| &s.sensor).eq(&stops));
    }
}

fn insertion_adds_up(scenario: &Scenario, plan: &voltour_solver::plan::Plan, why: &WhyUnserved) {
    let Some(insertion) = &why.insertion else {
        assert_eq!(why.reason, Reason::AlreadyCharged);
        return;
    };
    let request = |id: &str| {
        scenario.requests.iter().position(|r| scenario.sensors[r.sensor].id == id).unwrap()
    };
    let mut order: Vec<usize> = plan.stops.iter().map(|stop| request(&stop.sensor)).collect();
    let at = insertion
        .after
        .as_ref()
        .map_or(0, |after| 1 + plan.stops.iter().position(|stop| stop.sensor == *after).unwrap());
    order.insert(at, request(&why.sensor));
    let then = plan_from_order(scenario, &order, "auto");
    assert!((then.distance_m - plan.distance_m - insertion.extra_m).abs() < 1e-6);
    assert!((then.finish_s - plan.finish_s - insertion.extra_s).abs() < 1e-6);
    let energy = |p: &voltour_solver::plan::Plan| p.charge_j + p.travel_j;
    assert!((energy(&then) - energy(plan) - insertion.extra_j).abs() < 1e-6);
    // The oracle says whether the new tour keeps its limits.
    assert_eq!(mixed::worth(scenario, &order).is_some(), insertion.breaks.is_empty());
    for breach in &insertion.breaks {
        match breach {
            Breach::Deadline { sensor, arrive_s, deadline_s } => {
                let stop = then.stops.iter().find(|stop| stop.sensor == *sensor).unwrap();
                assert!(agrees(stop.arrive_s, *arrive_s) && arrive_s > deadline_s);
            }
            Breach::Capacity { energy_j, .. } => assert!(agrees(energy(&then), *energy_j)),
            Breach::Timespan { finish_s, .. } => assert!(agrees(then.finish_s, *finish_s)),
        }
    }
}

#[test]
fn what_a_stop_is_said_to_be_good_for_is_lost_without_it() {
    let mut told = 0;
    for seed in 0..800 {
        let Ok(scenario) = Scenario::from_document(&mixed::draw(5, seed)) else { continue };
        let plan = plan(&scenario, 60);
        if !plan.status.is_feasible() {
            continue;
        }
        let explanation = explain(&scenario, &plan, 0, &MaxIterations(1_000));
        let request = |id: &str| {
            scenario.requests.iter().position(|r| scenario.sensors[r.sensor].id == id).unwrap()
        };
        let order: Vec<usize> = plan.stops.iter().map(|stop| request(&stop.sensor)).collect();
        for (i, stop) in explanation.served.iter().enumerate() {
            let mut rest = order.clone();
            rest.remove(i);
            let without = plan_from_order(&scenario, &rest, "auto");
            assert!((plan.distance_m - without.distance_m - stop.saves_m).abs() < 1e-6);
            let asked = stop.required || !stop.short.is_empty();
            assert_eq!(asked, !without.violations.is_empty(), "{:?} {stop:?}", scenario.name);
            told += usize::from(asked);
        }
    }
    assert!(told > 100, "{told}");
}
