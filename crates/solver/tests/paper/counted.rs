//! `app` where moving sensors are counted within a time span.

use voltour_solver::generate::{Mobile, mobile};
use voltour_solver::scenario::{Place, Point, Scenario};
use voltour_solver::solvers::{PaperOptions, SolverName, Unfinished};

use crate::run::{AMPLE, attempt, optimum, parsed, plan, trials};

fn draw(sensors: u32, timespan_s: f64, seed: u64) -> Scenario {
    parsed(&mobile(&Mobile { sensors, timespan_s, ..Mobile::default() }, seed).unwrap())
}

fn with(app_level: u32, app_step_s: f64, app_epsilon: f64) -> PaperOptions {
    PaperOptions { app_level, app_step_s, app_epsilon, ..PaperOptions::default() }
}

fn served(scenario: &Scenario, options: &PaperOptions) -> usize {
    plan(scenario, SolverName::App, options).stops.len()
}

#[test]
fn it_beats_no_optimum_and_its_level_bounds_it() {
    let mut total = [0; 3];
    for seed in 0..trials(20) {
        let scenario = draw(7, 1_000.0, seed);
        let best = optimum(&scenario).unwrap().objective as usize;
        for (level, total) in (1..).zip(&mut total) {
            let stops = served(&scenario, &with(level, 120.0, 0.0));
            assert!(stops < 1 << level && stops <= best, "{:?}: {stops} {best}", scenario.name);
            *total += stops;
        }
    }
    assert!(total[0] < total[1] && total[1] < total[2], "{total:?}");
}

#[test]
fn finer_steps_charge_more_sensors() {
    let total = |step_s| {
        (0..trials(15)).map(|seed| served(&draw(8, 1_200.0, seed), &with(3, step_s, 0.0))).sum()
    };
    let totals: [usize; 2] = [300.0, 90.0].map(total);
    assert!(totals[0] < totals[1], "{totals:?}");
}

/// The most of two sensors that the time-expanded graph has a path through.
fn on_the_grid(scenario: &Scenario, step_s: f64) -> usize {
    fn most(s: &Scenario, step_s: f64, from: (Point, f64), charged: &[usize]) -> Option<usize> {
        let until_s = s.charger.timespan_s.unwrap();
        let reach =
            |to: Point, by_s: f64| from.1 + (to - from.0).norm() / s.charger.speed_mps <= by_s;
        let mut best = reach(s.charger.end_m, until_s).then_some(charged.len());
        for next in (0..s.requests.len()).filter(|next| !charged.contains(next)) {
            let request = &s.requests[next];
            if s.already_charged(request) {
                continue;
            }
            let mut time_s = 0.0;
            while time_s <= until_s {
                let place: Point = match &s.sensors[request.sensor].place {
                    Place::Fixed(point) => *point,
                    moving => moving.at(time_s),
                };
                let depart_s =
                    time_s + (s.target_j(request) - request.residual_j) / s.charger.transfer_w;
                if reach(place, time_s) && depart_s <= until_s {
                    let charged = [charged, &[next]].concat();
                    best = best.max(most(s, step_s, (place, depart_s), &charged));
                }
                time_s += step_s;
            }
        }
        best
    }
    most(scenario, step_s, (scenario.charger.start_m, 0.0), &[]).unwrap()
}

#[test]
fn two_sensors_are_charged_wherever_the_graph_has_a_path() {
    let mut counts = [0; 3];
    for seed in 0..trials(150) {
        let scenario = draw(2, 120.0 + 10.0 * (seed % 40) as f64, seed);
        let expected = on_the_grid(&scenario, 50.0);
        let stops = served(&scenario, &with(2, 50.0, 0.0));
        assert_eq!(stops, expected, "{:?}", scenario.name);
        counts[stops] += 1;
    }
    assert!(counts.iter().all(|&count| count > 5), "{counts:?}");
}

#[test]
fn a_plan_with_an_epsilon_is_driven_with_whole_charges() {
    for seed in 0..trials(15) {
        let scenario = draw(8, 900.0, seed);
        let best = optimum(&scenario).unwrap().objective as usize;
        for epsilon in [0.05, 0.3, 0.9] {
            assert!(served(&scenario, &with(3, 90.0, epsilon)) <= best);
        }
    }
}

#[test]
fn limits_end_it_without_a_tour_and_options_are_looked_at() {
    let scenario = draw(8, 1_200.0, 4);
    let small = PaperOptions { memory_bytes: 1_000, ..with(3, 90.0, 0.0) };
    let outcome = attempt(&scenario, SolverName::App, &small, AMPLE).unwrap();
    assert_eq!((outcome.unfinished, outcome.plan.stops.len()), (Some(Unfinished::Memory), 0));
    let outcome = attempt(&scenario, SolverName::App, &with(3, 90.0, 0.0), 50).unwrap();
    assert_eq!((outcome.unfinished, outcome.plan.stops.len()), (Some(Unfinished::Budget), 0));
    for bad in [with(0, 90.0, 0.0), with(40, 90.0, 0.0), with(3, 0.0, 0.0), with(3, 90.0, 1.0)] {
        assert!(attempt(&scenario, SolverName::App, &bad, 1).is_err());
    }
}
