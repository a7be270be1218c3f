//! What the tour keeps agrees with plain forward simulation.

use proptest::prelude::*;

use super::{Insertion, Segment, Tour, simulate};
use crate::generate::{Reward, reward};
use crate::instance::Instance;
use crate::scenario::{Scenario, TravelDocument};

/// Stops: place, ready, window, drain, residual share of what the deadline allows.
type Stop = (f64, f64, f64, f64, f64);

fn scenario(stops: &[Stop], capacity: bool, saturating: bool) -> Scenario {
    let waits = !capacity || stops.iter().all(|s| s.3 == 0.0);
    let sensors: Vec<String> = stops
        .iter()
        .enumerate()
        .map(|(i, s)| format!(r#"{{"id":"s{i}","position_m":[{},{}],"battery_j":200}}"#, s.0, s.1))
        .collect();
    let requests: Vec<String> = stops
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let ready = if waits { s.1 } else { 0.0 };
            let due = ready + 100.0 + 400.0 * s.2;
            let residual = if saturating { 20.0 * s.4 } else { (s.3 * due).min(150.0) };
            let drain = if saturating { s.3 } else { residual / due };
            format!(
                r#"{{"sensor":"s{i}","ready_s":{ready},"deadline_s":{due},"drain_w":{drain},"residual_j":{residual}}}"#
            )
        })
        .collect();
    let text = format!(
        r#"{{"format":"voltour/scenario/1","objective":"max_count",
        "charger":{{"start_m":[50,50],"speed_mps":5,"travel_jpm":2,"transfer_w":20,
        "timespan_s":600,"capacity_j":{}}},"sensors":[{}],"requests":[{}]}}"#,
        if capacity { "1500" } else { "null" },
        sensors.join(","),
        requests.join(",")
    );
    Scenario::from_json(text.as_bytes()).unwrap()
}

fn stops() -> impl Strategy<Value = Vec<Stop>> {
    let stop = (0.0..100.0, 0.0..100.0, 0.0..1.0, prop_oneof![Just(0.0), 0.0..1.0], 0.0..1.0);
    prop::collection::vec(stop, 2..9)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-7 * (1.0 + b.abs())
}

proptest! {
    #[test]
    fn where_totals_decide_the_shortest_place_is_the_cheapest(
        seed in 0..1_000_u64,
        stops in 0..6_usize,
        ways in prop::option::of(prop::collection::vec(1.0..50.0, 14 * 14)),
    ) {
        let options = Reward { sensors: 12, alpha: 1.0, capacity_j: 400_000.0, ..Reward::default() };
        let mut document = reward(&options, seed).unwrap();
        document.travel = ways.map(|ways| {
            let mut distance_m: Vec<Vec<f64>> = ways.chunks(14).map(<[f64]>::to_vec).collect();
            (0..14).for_each(|i| distance_m[i][i] = 0.0);
            TravelDocument { distance_m }
        });
        let scenario = Scenario::from_document(&document).unwrap();
        let instance = Instance::new(&scenario);
        prop_assert!(instance.untimed);
        let order: Vec<u32> = (0..instance.len() as u32).take(stops).collect();
        let tour = Tour::new(&instance, &order);
        for candidate in stops as u32..instance.len() as u32 {
            let places = (0..=stops).filter_map(|p| tour.insertion(&instance, p, candidate));
            let cheapest = places.min_by(|a, b| a.effort.total_cmp(&b.effort));
            let effort = |place: Option<Insertion>| place.map(|place| place.effort);
            prop_assert_eq!(effort(tour.cheapest(&instance, candidate)), effort(cheapest));
        }
    }

    #[test]
    fn concatenated_equals_simulated(stops in stops(), capacity: bool, cut in 0.0..1.0) {
        let scenario = scenario(&stops, capacity, false);
        let instance = Instance::new(&scenario);
        prop_assume!(instance.segments);
        let order: Vec<u32> = (0..instance.len() as u32).collect();
        // Concatenation is associative: join left and right of any cut first.
        let cut = 1 + (cut * (order.len() - 1) as f64) as usize;
        let join = |part: &[u32]| {
            let stops = part.iter().map(|&c| Segment::stop(&instance, c));
            stops.reduce(|run, stop| run.then(&instance, &stop)).unwrap()
        };
        let mut whole = join(&order[..cut]);
        if cut < order.len() {
            whole = whole.then(&instance, &join(&order[cut..]));
        }
        let whole = whole.then(&instance, &Segment::end(&instance));
        let (runs, _) = simulate(&instance, &order);
        let in_time = runs[..order.len()].iter().all(|run| instance.in_time(run))
            && runs[order.len()].arrive_s <= instance.timespan_s;
        let end = whole.after(&instance, &instance.departure());
        prop_assert_eq!(end.is_some(), in_time);
        if let Some(end) = end {
            prop_assert!(close(end.arrive_s, runs[order.len()].arrive_s));
            prop_assert!(close(end.distance_m, runs[order.len()].distance_m));
            if capacity {
                prop_assert!(close(end.charge_j, runs[order.len()].charge_j));
            }
        }
    }

    #[test]
    fn an_insertion_is_legal_where_the_simulation_is(
        stops in stops(), capacity: bool, saturating: bool, at in 0.0..1.0,
    ) {
        let scenario = scenario(&stops, capacity, saturating);
        let instance = Instance::new(&scenario);
        let mut order: Vec<u32> = (1..instance.len() as u32).collect();
        // Only from a legal tour.
        while !simulate(&instance, &order).1 {
            order.pop();
        }
        let mut tour = Tour::new(&instance, &order);
        prop_assert!(tour.is_legal());
        let position = (at * (order.len() + 1) as f64) as usize;
        let found = tour.insertion(&instance, position, 0);
        order.insert(position, 0);
        prop_assert_eq!(found.is_some(), simulate(&instance, &order).1);
        if found.is_some() {
            tour.insert(&instance, position, 0);
            prop_assert_eq!(tour.order(), &order[..]);
            let backwards: Vec<u32> = order.iter().rev().copied().collect();
            let end = tour.rearranged(&instance, 0, &backwards);
            let (runs, legal) = simulate(&instance, &backwards);
            prop_assert_eq!(end.is_some(), legal);
            prop_assert!(end.is_none_or(|end| close(end.distance_m, runs[order.len()].distance_m)));
            tour.remove(&instance, |c| c == 0);
            let again = Tour::new(&instance, tour.order());
            prop_assert!(close(again.finished().arrive_s, tour.finished().arrive_s));
            prop_assert_eq!(again.insertion(&instance, position, 0), found);
        }
    }
}
