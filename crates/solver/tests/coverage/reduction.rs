//! Demands: what each region asks for, and that dropping the implied ones changes nothing.

use proptest::prelude::*;
use voltour_solver::coverage::{Demand, demands, regions, shortfalls};

use crate::world::World;

fn short_form(demands: &[Demand]) -> Vec<(&[u32], u32)> {
    demands.iter().map(|demand| (&demand.members[..], demand.needs)).collect()
}

fn demands_of(world: &World) -> Vec<Demand> {
    let scenario = world.scenario();
    demands(&scenario, &regions(&scenario))
}

#[test]
fn region_of_one_asks_for_it() {
    let mut world = World::square(10.0, &[[5.0, 5.0, 9.0], [5.0, 5.0, 2.0]]);
    world.requests = vec![(0, false)];
    assert_eq!(short_form(&demands_of(&world)), [(&[0][..], 1)]);
}

#[test]
fn sensors_that_stay_alive_lower_the_demand() {
    let disks = [[5.0, 5.0, 9.0], [5.0, 5.0, 9.5], [5.0, 5.0, 9.6]];
    let mut world = World::square(10.0, &disks);
    world.requests = vec![(2, false), (0, false), (1, true)];
    for (k, needs) in [(1, None), (2, Some(1)), (3, Some(2)), (9, Some(2))] {
        world.k = k;
        let expected: Vec<(&[u32], u32)> =
            needs.map(|needs| (&[0, 1][..], needs)).into_iter().collect();
        assert_eq!(short_form(&demands_of(&world)), expected, "k = {k}");
    }
}

#[test]
fn implied_demands_are_dropped() {
    // Regions {0, 1} and {0, 1, 2}: one of the first two serves both.
    let mut world = World::square(10.0, &[[5.0, 5.0, 9.0], [5.0, 5.0, 9.5], [5.0, 5.0, 2.0]]);
    world.requests = vec![(0, false), (1, false), (2, false)];
    assert_eq!(short_form(&demands_of(&world)), [(&[0, 1][..], 1)]);
    // Two of {0, 1} or two of {0, 1, 2}: the former implies the latter.
    world.k = 2;
    assert_eq!(short_form(&demands_of(&world)), [(&[0, 1][..], 2)]);
    // All three in the middle, which imply the rest.
    world.k = 3;
    assert_eq!(short_form(&demands_of(&world)), [(&[0, 1, 2][..], 3)]);
}

#[test]
fn witness_lies_where_the_demand_arises() {
    let mut world = World::square(10.0, &[[2.0, 5.0, 1.0], [8.0, 5.0, 1.0]]);
    world.requests = vec![(1, false)];
    let [demand] = &demands_of(&world)[..] else { panic!("one demand expected") };
    assert_eq!(world.covering(demand.witness.x, demand.witness.y), [1]);
}

fn worlds() -> impl Strategy<Value = World> {
    let disk = (0..20, 0..20, prop::sample::select(vec![3, 5, 5, 8, 13]));
    let disk = disk.prop_map(|(x, y, r)| [f64::from(x), f64::from(y), f64::from(r)]);
    let asks = prop_oneof![4 => Just(Some(false)), 1 => Just(Some(true)), 2 => Just(None)];
    let sensors = prop::collection::vec((disk, asks), 1..11);
    (sensors, 1u32..5, any::<bool>()).prop_map(|(sensors, k, reverse)| {
        let disks: Vec<_> = sensors.iter().map(|sensor| sensor.0).collect();
        let asking = sensors.iter().enumerate().filter_map(|(i, sensor)| Some((i, sensor.1?)));
        let mut requests: Vec<_> = asking.collect();
        if reverse {
            requests.reverse();
        }
        World { k, requests, ..World::square(20.0, &disks) }
    })
}

fn meets(demands: &[Demand], served: u32) -> bool {
    let count = |demand: &Demand| demand.members.iter().filter(|&&m| served >> m & 1 == 1).count();
    demands.iter().all(|demand| count(demand) >= demand.needs as usize)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn reduced_demands_accept_the_same_subsets(world in worlds()) {
        let scenario = world.scenario();
        let regions = regions(&scenario);
        let reduced = demands(&scenario, &regions);
        for served in 0..1u32 << world.requests.len() {
            let short = shortfalls(&scenario, &regions, |request| served >> request & 1 == 1);
            prop_assert_eq!(meets(&reduced, served), short.is_empty(), "served {:b}", served);
        }
    }

    #[test]
    fn no_remaining_demand_is_implied_by_another(world in worlds()) {
        let reduced = demands_of(&world);
        for (i, weak) in reduced.iter().enumerate() {
            prop_assert!(1 <= weak.needs && weak.needs as usize <= weak.members.len());
            prop_assert!(weak.members.is_sorted_by(|a, b| a < b));
            prop_assert!(weak.members.iter().all(|&m| !world.requests[m as usize].1));
            for strong in reduced.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, d)| d) {
                // Whoever is served, strong met means weak met: the formula, by enumeration.
                let all = 0..1u32 << world.requests.len();
                let strong = std::slice::from_ref(strong);
                let weak = std::slice::from_ref(weak);
                let implied = all.into_iter().all(|s| !meets(strong, s) || meets(weak, s));
                prop_assert!(!implied, "{:?} implies {:?}", strong, weak);
            }
        }
    }
}
