//! `dp` against every order, with arrivals rounded up to the step, and against the proven optimum.

use voltour_solver::generate::{KCoverage, k_coverage};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Objective, Place, Point, Scenario};
use voltour_solver::solvers::{PaperOptions, SolverName, Unfinished};
use voltour_solver::tolerance::solver_limit;

use crate::mixed;
use crate::run::{AMPLE, attempt, optimum, order, parsed, plan, trials};

fn stepping(dp_step_s: f64) -> PaperOptions {
    PaperOptions { dp_step_s, ..PaperOptions::default() }
}

/// A scenario for which there is a dynamic programme.
fn shortest(requests: usize, seed: u64) -> Option<Scenario> {
    let mut document = mixed::draw(requests, seed);
    document.objective = Objective::MinDistance;
    document.travel = None;
    document.charger.capacity_j = None;
    let at_rest = document.sensors.iter().all(|sensor| sensor.position_m.is_some());
    at_rest.then(|| Scenario::from_document(&document).ok()).flatten()
}

fn at(scenario: &Scenario, request: usize) -> Point {
    match scenario.sensors[scenario.requests[request].sensor].place {
        Place::Fixed(point) => point,
        Place::Moving(_) => panic!("at rest"),
    }
}

/// Whether an order keeps its deadlines, by `late_s` at most, and the time span with every arrival rounded up.
fn keeps_rounded_up(scenario: &Scenario, order: &[usize], step_s: f64, late_s: f64) -> bool {
    let charger = &scenario.charger;
    let (mut time_s, mut here) = (0.0, charger.start_m);
    for &stop in order {
        let request = &scenario.requests[stop];
        let reach_s = time_s + (at(scenario, stop) - here).norm() / charger.speed_mps;
        let arrive_s = (reach_s.max(request.ready_s) / step_s).ceil() * step_s;
        let due_s = request.deadline_s.map_or(f64::INFINITY, solver_limit);
        if arrive_s > due_s + late_s {
            return false;
        }
        let left_j = (request.residual_j - request.drain_w * arrive_s).max(0.0);
        time_s = arrive_s + (scenario.target_j(request) - left_j) / charger.transfer_w;
        here = at(scenario, stop);
    }
    let finish_s = time_s + (charger.end_m - here).norm() / charger.speed_mps;
    charger.timespan_s.is_none_or(|limit| finish_s <= solver_limit(limit) + late_s)
}

/// The least length of a feasible order that keeps its deadlines with arrivals rounded up.
fn least(scenario: &Scenario, step_s: f64, late_s: f64) -> Option<f64> {
    let mut best: Option<f64> = None;
    extend(scenario, step_s, late_s, &mut Vec::new(), &mut best);
    best
}

fn extend(s: &Scenario, step_s: f64, late_s: f64, order: &mut Vec<usize>, best: &mut Option<f64>) {
    if !keeps_rounded_up(s, order, step_s, late_s) {
        return;
    }
    if let Some((0, 0, length_m, _)) = mixed::worth(s, order) {
        *best = Some(best.map_or(length_m, |best| best.min(length_m)));
    }
    for next in 0..s.requests.len() {
        if !order.contains(&next) && !s.already_charged(&s.requests[next]) {
            order.push(next);
            extend(s, step_s, late_s, order, best);
            order.pop();
        }
    }
}

#[test]
fn it_finds_the_shortest_tour_with_arrivals_rounded_up() {
    let (mut with, mut without) = (0, 0);
    for seed in 0..trials(1_500) {
        let Some(scenario) = shortest(1 + seed as usize % 5, seed) else { continue };
        for step_s in [1.0, 3.7, 25.0] {
            let name = &scenario.name;
            let plan = plan(&scenario, SolverName::Dp, &stepping(step_s));
            let expected = least(&scenario, step_s, 0.0);
            if expected != least(&scenario, step_s, 1e-6)
                || expected != least(&scenario, step_s, -1e-6)
            {
                continue;
            }
            match expected {
                Some(least) => {
                    assert!(plan.status.is_feasible(), "{name:?} {step_s}: {least} exists");
                    assert!(
                        (plan.objective - least).abs() < 1e-6,
                        "{name:?}: {least} {}",
                        plan.objective
                    );
                    with += 1;
                }
                None => {
                    assert!(
                        !plan.status.is_feasible() && plan.stops.is_empty(),
                        "{name:?} {step_s}"
                    );
                    without += 1;
                }
            }
        }
    }
    assert!(with > 300 && without > 50, "{with} {without}");
}

fn cell(sensors: u32, k: u32, alpha: f64, seed: u64) -> Scenario {
    parsed(&k_coverage(&KCoverage { sensors, k, alpha, ..KCoverage::default() }, seed).unwrap())
}

#[test]
fn it_is_never_better_than_the_optimum_and_equal_where_that_can_be_rounded() {
    let (mut equal, mut worse) = (0, 0);
    for (sensors, k, alpha) in [(32, 2, 0.2), (48, 3, 0.2), (64, 2, 0.45)] {
        for seed in 0..trials(12) {
            let scenario = cell(sensors, k, alpha, seed);
            let best = optimum(&scenario);
            for step_s in [1.0, 300.0, 1_500.0] {
                let options = PaperOptions { memory_bytes: 64 << 20, ..stepping(step_s) };
                let outcome = attempt(&scenario, SolverName::Dp, &options, AMPLE).unwrap();
                if outcome.unfinished.is_none() {
                    let rounded = compare(&scenario, &outcome.plan, best.as_ref(), step_s);
                    *(if rounded { &mut equal } else { &mut worse }) += 1;
                }
            }
        }
    }
    assert!(equal > 20 && worse > 2, "{equal} {worse}");
}

/// Whether the optimal tour can be rounded, so that the plan has to be as short.
fn compare(scenario: &Scenario, plan: &Plan, best: Option<&Plan>, step_s: f64) -> bool {
    let Some(best) = best else {
        assert!(!plan.status.is_feasible(), "{:?}", scenario.name);
        return false;
    };
    if plan.status.is_feasible() {
        assert!(plan.objective >= best.objective - 1e-4, "{:?}", scenario.name);
    }
    let rounded = keeps_rounded_up(scenario, &order(scenario, best), step_s, -1e-3);
    if rounded {
        assert!(plan.status.is_feasible(), "{:?}", scenario.name);
        assert!((plan.objective - best.objective).abs() < 1e-3, "{:?}", scenario.name);
    }
    rounded
}

#[test]
fn what_does_not_come_to_its_end_has_no_tour() {
    let scenario = cell(32, 2, 0.6, 3);
    let limits = [(4 << 20, AMPLE, Unfinished::Memory), (1 << 30, 500, Unfinished::Budget)];
    for (memory_bytes, iterations, expected) in limits {
        let options = PaperOptions { memory_bytes, ..PaperOptions::default() };
        let outcome = attempt(&scenario, SolverName::Dp, &options, iterations).unwrap();
        assert_eq!(outcome.unfinished, Some(expected));
        assert!(outcome.plan.stops.is_empty());
    }
    for step_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(attempt(&scenario, SolverName::Dp, &stepping(step_s), 1).is_err());
    }
}
