//! Random small scenarios that mix every feature of the format, and an oracle that is meant to be easy
//! to read: it simulates every order of every subset as `formats.md` says, step by step.
#![allow(dead_code)]

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use voltour_solver::coverage::regions;
use voltour_solver::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, Objective, Place, Point, RequestDocument,
    Scenario, SensorDocument, TravelDocument,
};
use voltour_solver::tolerance::solver_limit;

/// A scenario of `n` requests, most features drawn at random.
pub fn draw(n: usize, seed: u64) -> Document {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let objectives = [Objective::MinDistance, Objective::MaxReward, Objective::MaxCount];
    let objective = objectives[rng.random_range(0..3)];
    let moving = rng.random_bool(0.2);
    let coverage = !moving && rng.random_bool(0.4);
    let matrix = !moving && rng.random_bool(0.3);
    let spare = rng.random_range(0..3);
    let mut point = {
        let mut rng = Pcg64Mcg::seed_from_u64(seed ^ 77);
        move || [rng.random_range(0.0..100.0_f64).round(), rng.random_range(0.0..100.0_f64).round()]
    };
    let sensors = (0..n + spare).map(|i| SensorDocument {
        id: format!("s{i}"),
        position_m: (!moving || i % 2 == 1).then(&mut point),
        trajectory: (moving && i % 2 == 0).then(|| {
            let rows = 1 + i % 3;
            let row = |j: usize| {
                let at = point();
                [40.0 * j as f64 - 10.0, at[0], at[1]]
            };
            (0..rows).map(row).collect()
        }),
        range_m: coverage.then_some(60.0 + 10.0 * (i % 4) as f64),
        battery_j: 100.0,
    });
    let sensors: Vec<SensorDocument> = sensors.collect();
    let deadlines = rng.random_bool(0.6);
    let waits = rng.random_bool(0.3);
    let drains = rng.random_bool(0.5);
    let required = if rng.random_bool(0.3) { 0.4 } else { 0.0 };
    let requests = (0..n).map(|i| {
        let ready = if waits && rng.random_bool(0.5) { rng.random_range(0.0..60.0) } else { 0.0 };
        let due = ready + rng.random_range(5.0..120.0);
        RequestDocument {
            sensor: format!("s{i}"),
            ready_s: Some(ready),
            deadline_s: (deadlines && rng.random_bool(0.8)).then_some(due),
            residual_j: rng.random_bool(0.7).then(|| rng.random_range(0.0..100.0)),
            drain_w: drains.then(|| rng.random_range(0.0..2.0)),
            reward: rng.random_bool(0.5).then(|| f64::from(rng.random_range(0..5))),
            required: Some(rng.random_bool(required)),
        }
    });
    let requests: Vec<RequestDocument> = requests.collect();
    let size = n + 2;
    let mut row = || (0..size).map(|_| rng.random_range(0.0..100.0_f64).round()).collect();
    let travel = matrix.then(|| TravelDocument { distance_m: (0..size).map(|_| row()).collect() });
    Document {
        format: FORMAT.to_owned(),
        name: Some(format!("mixed-{seed}")),
        objective,
        charger: ChargerDocument {
            start_m: [50.0, 50.0],
            end_m: rng.random_bool(0.5).then_some([80.0, 20.0]),
            speed_mps: 5.0,
            travel_jpm: 1.0,
            transfer_w: 10.0,
            capacity_j: rng.random_bool(0.4).then(|| rng.random_range(20.0..500.0)),
            timespan_s: rng.random_bool(0.4).then(|| rng.random_range(5.0..100.0)),
        },
        charge_level: rng.random_bool(0.3).then_some(0.6),
        coverage: coverage.then(|| CoverageDocument {
            k: f64::from(rng.random_range(1..3)),
            field_m: vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]],
        }),
        sensors,
        requests,
        travel,
    }
}

/// Missing required, missing covers, cost (smaller is better), tie.
pub type Worth = (usize, usize, f64, f64);

/// Whether `a` is better than `b` by more than rounding.
pub fn better(a: &Worth, b: &Worth) -> bool {
    let differ = |x: f64, y: f64| (x - y).abs() > 1e-7 * (1.0 + y.abs());
    if (a.0, a.1) != (b.0, b.1) {
        return (a.0, a.1) < (b.0, b.1);
    }
    if differ(a.2, b.2) { a.2 < b.2 } else { differ(a.3, b.3) && a.3 < b.3 }
}

/// What an order of requests is worth; `None` where it breaks constraint 1, 2 or 3.
pub fn worth(scenario: &Scenario, order: &[usize]) -> Option<Worth> {
    let charger = &scenario.charger;
    let (mut time, mut here, mut length, mut charged) = (0.0, charger.start_m, 0.0, 0.0);
    let mut row = 0;
    for &r in order {
        let request = &scenario.requests[r];
        let place = &scenario.sensors[request.sensor].place;
        let leg =
            |to: Point| scenario.travel.as_ref().map_or((to - here).norm(), |t| t.get(row, r + 2));
        let mut arrive = match place {
            Place::Fixed(point) => time + leg(*point) / charger.speed_mps,
            Place::Moving(_) => {
                // Bisection: the charger is faster, so once in reach, always in reach.
                let late = |t: f64| (place.at(t) - here).norm() > charger.speed_mps * (t - time);
                let (mut low, mut high) = (time, time + 1e4);
                for _ in 0..200 {
                    let middle = 0.5 * (low + high);
                    if late(middle) { low = middle } else { high = middle }
                }
                high
            }
        };
        arrive = arrive.max(request.ready_s);
        if request.deadline_s.is_some_and(|deadline| arrive > solver_limit(deadline)) {
            return None;
        }
        let left = (request.residual_j - request.drain_w * arrive).max(0.0);
        let charge = (scenario.target_j(request) - left).max(0.0);
        length += leg(place.at(arrive));
        here = place.at(arrive);
        time = arrive + charge / charger.transfer_w;
        charged += charge;
        row = r + 2;
    }
    let leg = scenario.travel.as_ref().map_or((charger.end_m - here).norm(), |t| t.get(row, 1));
    length += leg;
    time += leg / charger.speed_mps;
    let energy = charged + charger.travel_jpm * length;
    if charger.timespan_s.is_some_and(|limit| time > solver_limit(limit))
        || charger.capacity_j.is_some_and(|limit| energy > solver_limit(limit))
    {
        return None;
    }
    let (cost, tie) = match scenario.objective {
        Objective::MinDistance => (length, 0.0),
        Objective::MaxReward => {
            (-order.iter().map(|&r| scenario.requests[r].reward).sum::<f64>(), length)
        }
        Objective::MaxCount => (-(order.len() as f64), time),
    };
    let (required, covers) = missing(scenario, order);
    Some((required, covers, cost, tie))
}

fn missing(scenario: &Scenario, order: &[usize]) -> (usize, usize) {
    let asks = |r: &usize| !order.contains(r);
    let unserved: Vec<usize> = (0..scenario.requests.len()).filter(asks).collect();
    let required = unserved.iter().filter(|&&r| scenario.requests[r].required).count();
    // An already charged `required` request is kept.
    let charged = |r: &&usize| scenario.already_charged(&scenario.requests[**r]);
    let kept = unserved.iter().filter(charged).filter(|&&r| scenario.requests[r].required).count();
    let lost: Vec<usize> = unserved
        .iter()
        .filter(|&&r| !scenario.already_charged(&scenario.requests[r]))
        .map(|&r| scenario.requests[r].sensor)
        .collect();
    let k = scenario.coverage.as_ref().map_or(0, |coverage| coverage.k as usize);
    let short = regions(scenario).into_iter().map(|region| {
        let has = region.covering.iter().filter(|&&s| !lost.contains(&(s as usize))).count();
        k.min(region.covering.len()).saturating_sub(has)
    });
    (required - kept, short.sum())
}

/// The best of all tours; `None` where not one keeps constraints 1 to 3.
pub fn oracle(scenario: &Scenario) -> Option<Worth> {
    let mut best = None;
    extend(scenario, &mut Vec::new(), &mut best);
    best
}

fn extend(scenario: &Scenario, order: &mut Vec<usize>, best: &mut Option<Worth>) {
    if let Some(new) = worth(scenario, order)
        && best.as_ref().is_none_or(|old| better(&new, old))
    {
        *best = Some(new);
    }
    for r in 0..scenario.requests.len() {
        if !order.contains(&r) && !scenario.already_charged(&scenario.requests[r]) {
            order.push(r);
            extend(scenario, order, best);
            order.pop();
        }
    }
}
