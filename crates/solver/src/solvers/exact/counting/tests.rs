//! Timetables against exact steps, and counts against every order of tiny scenarios.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::Timetable;
use super::proof::{Look, applies, count, count_with};
use crate::instance::Instance;
use crate::scenario::{Document, Objective, Scenario};
use crate::solvers::Budget;
use crate::solvers::exact::network::stand;
use crate::solvers::exact::{Aim, Effort, Incumbent, Model};
use crate::stop::MaxIterations;
use crate::tour::Run;

// Shared with the tests of the exact solver's claims.
#[allow(clippy::duplicate_mod, dead_code)]
#[path = "../../../../tests/exact/draw.rs"]
mod draw;

use draw::Ground;

fn trials(default: u64) -> u64 {
    std::env::var("VOLTOUR_TRIALS").map_or(default, |n| n.parse().unwrap())
}

/// A scenario that is about time alone: deadlines, ready times and drains as they come.
fn about_time(seed: u64) -> Document {
    let rng = &mut Pcg64Mcg::seed_from_u64(seed);
    let ground = [Ground::Moving, Ground::Moving, Ground::Moving, Ground::Plane, Ground::OnePlace];
    let ground = ground[rng.random_range(0..ground.len())];
    let mut document = draw::on(ground, rng.random_range(1..=6), 77_000_000 + seed);
    document.objective = Objective::MaxCount;
    document.coverage = None;
    document.sensors.iter_mut().for_each(|sensor| sensor.range_m = None);
    document.requests.iter_mut().for_each(|request| request.required = None);
    document.charger.capacity_j = None;
    document.charger.timespan_s = Some(rng.random_range(15.0..250.0));
    document
}

/// The most stops after this run, trying every order.
fn most_stops(instance: &Instance<'_>, run: &Run, served: u64) -> Option<usize> {
    let here = instance.keeps_limits(&instance.finish(run)).then_some(0);
    let others = (0..instance.len() as u32).filter(|to| served >> to & 1 == 0);
    let further = others.filter_map(|to| {
        let next = instance.step(run, to);
        let ahead = || most_stops(instance, &next, served | 1 << to);
        instance.in_time(&next).then(ahead).flatten().map(|stops| stops + 1)
    });
    further.chain(here).max()
}

#[test]
fn timetables_hold_at_every_moment() {
    let rng = &mut Pcg64Mcg::seed_from_u64(1);
    for seed in 0..trials(300) {
        let scenario = Scenario::from_document(&about_time(seed)).unwrap();
        let instance = Instance::new(&scenario);
        let mut budget = Budget::new(&MaxIterations(u64::MAX));
        let table = Timetable::new(&instance, 1 + seed as usize % 40, &mut budget).unwrap();
        for _moment in 0..30 {
            let time_s = rng.random_range(0.0..=instance.timespan_s);
            let b = table.interval(time_s);
            for from in 0..instance.len() {
                let run = stand(&instance, from, time_s);
                let end_s = instance.finish(&run).arrive_s;
                if end_s <= instance.timespan_s {
                    assert!(table.ends(b)[from] <= end_s - time_s, "{seed}: {from} to the end");
                }
                for to in (0..instance.len()).filter(|&to| to != from) {
                    let next = instance.step(&run, to as u32);
                    if instance.in_time(&next) && next.arrive_s <= instance.timespan_s {
                        let hop = table.hops(b, from)[to];
                        let name = format!("{seed}: {from} to {to} from {time_s}: {hop:?}");
                        assert!(f64::from(hop.least_s) <= next.arrive_s - time_s, "{name}");
                        let arrives = table.interval(next.arrive_s) as u16;
                        assert!((hop.first..=hop.last).contains(&arrives), "{name}: {arrives}");
                    }
                }
            }
        }
    }
}

#[test]
fn counts_agree_with_every_order() {
    let whole = |intervals, steps| Look { intervals, steps, width: usize::MAX };
    let narrow = |intervals, steps| Look { intervals, steps, width: 2 };
    let looks = [
        vec![whole(1, 0)],
        vec![whole(9, 3)],
        vec![whole(150, 12)],
        vec![narrow(5, 1), narrow(20, 4), whole(40, 4)],
        vec![narrow(30, 40)],
    ];
    let (mut counted, mut open) = (0, 0);
    for seed in 0..trials(1_500) {
        let scenario = Scenario::from_document(&about_time(seed)).unwrap();
        let instance = Instance::new(&scenario);
        let model = Model::new(&instance, Aim::Optimum);
        let mut incumbent = Incumbent::none(&model);
        // Nothing is known but the empty tour: all stops must be found.
        incumbent.offer(&model, Vec::new());
        if !applies(&model, &incumbent) {
            continue;
        }
        let stop = MaxIterations(1_000_000);
        let budget = &mut Budget::new(&stop);
        let looks = &looks[seed as usize % looks.len()];
        let proof = match seed % 7 {
            0 => count(&model, Effort::Whole, &mut incumbent, budget),
            1 | 2 => count_with::<2>(&model, looks, &mut incumbent, budget),
            _ => count_with::<1>(&model, looks, &mut incumbent, budget),
        };
        let start = instance.departure();
        let most = most_stops(&model.wide, &start, 0).unwrap() as f64;
        let kept = most_stops(model.strict, &start, 0).unwrap() as f64;
        assert!(-proof.bound >= most, "{seed}: {proof:?}, but {most}");
        if proof.closed {
            assert_eq!(-proof.bound, most, "{seed}");
            assert!(kept < most || -incumbent.cost == most, "{seed}: {proof:?}, but {kept}");
        } else {
            open += 1;
        }
        counted += 1;
    }
    // Only searches that gave labels up may leave it open.
    assert!(counted > 0 && 5 * open <= counted, "{open} open of {counted}");
}
