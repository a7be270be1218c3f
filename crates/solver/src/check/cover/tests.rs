//! The walk against plain evaluation at points, and the degenerate fields one by one.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::faces::{Sets, rounding, sets, survey};
use crate::scenario::{Point, Scenario};

fn scenario(field: &[[f64; 2]], disks: &[(f64, f64, f64)]) -> Scenario {
    let sensor = |(i, (x, y, r)): (usize, &(f64, f64, f64))| -> Value {
        json!({ "id": format!("s{i}"), "position_m": [x, y], "range_m": r, "battery_j": 1 })
    };
    let sensors: Vec<_> = disks.iter().enumerate().map(sensor).collect();
    let document = json!({
        "format": "voltour/scenario/1", "objective": "min_distance",
        "charger": { "start_m": [0, 0], "speed_mps": 1, "travel_jpm": 0, "transfer_w": 1 },
        "coverage": { "k": 1, "field_m": field }, "sensors": sensors, "requests": [],
    });
    Scenario::from_json(document.to_string().as_bytes()).unwrap()
}

fn all_sets(scenario: &Scenario) -> Sets {
    let (disks, field) = survey(scenario, scenario.coverage.as_ref().unwrap());
    sets(&disks, &field, &|_| true)
}

/// The sets that have a witness.
fn sure(field: &[[f64; 2]], disks: &[(f64, f64, f64)]) -> Vec<Vec<u32>> {
    let found = all_sets(&scenario(field, disks));
    found.into_iter().filter(|(_, witness)| witness.is_some()).map(|(set, _)| set).collect()
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

#[test]
fn no_disk_and_disks_beyond_the_field() {
    assert_eq!(sure(&SQUARE, &[]), [Vec::<u32>::new()]);
    assert_eq!(sure(&SQUARE, &[(30.0, 5.0, 3.0)]), [Vec::<u32>::new()]);
    assert_eq!(sure(&SQUARE, &[(5.0, 5.0, 30.0)]), [vec![0]]);
}

#[test]
fn a_disk_inside_a_disk_inside_the_field() {
    let disks = [(5.0, 5.0, 3.0), (5.0, 5.5, 1.0)];
    assert_eq!(sure(&SQUARE, &disks), [vec![], vec![0], vec![0, 1]]);
}

#[test]
fn an_inscribed_circle_touches_all_four_edges() {
    assert_eq!(sure(&SQUARE, &[(5.0, 5.0, 5.0)]), [vec![], vec![0]]);
}

#[test]
fn coincident_disks_cover_together() {
    let disks = [(5.0, 5.0, 3.0), (8.0, 5.0, 3.0), (5.0, 5.0, 3.0)];
    assert_eq!(sure(&SQUARE, &disks), [vec![], vec![0, 1, 2], vec![0, 2], vec![1]]);
    let whole = [(5.0, 5.0, 9.0), (5.0, 5.0, 9.0)];
    assert_eq!(sure(&SQUARE, &whole), [vec![0, 1]]);
}

#[test]
fn disks_that_touch_have_no_ground_in_common() {
    let outside = [(3.0, 5.0, 2.0), (7.0, 5.0, 2.0)];
    assert_eq!(sure(&SQUARE, &outside), [vec![], vec![0], vec![1]]);
    let inside = [(5.0, 5.0, 4.0), (7.0, 5.0, 2.0)];
    assert_eq!(sure(&SQUARE, &inside), [vec![], vec![0], vec![0, 1]]);
    // Along a diagonal no distance is exact; a lens of rounding is not insisted on.
    let r = 0.5 * 8_f64.sqrt();
    assert_eq!(sure(&SQUARE, &[(3.0, 5.0, r), (5.0, 7.0, r)]), [vec![], vec![0], vec![1]]);
}

#[test]
fn three_circles_through_one_point() {
    // Circles about three corners of a square, all through its centre.
    let r = 2_f64.sqrt();
    let found = sure(&SQUARE, &[(4.0, 4.0, r), (6.0, 4.0, r), (4.0, 6.0, r)]);
    assert_eq!(found, [vec![], vec![0], vec![0, 1], vec![0, 2], vec![1], vec![2]]);
}

#[test]
fn a_field_smaller_than_the_disks_corner_to_corner() {
    // The circle about one corner passes through two others.
    assert_eq!(sure(&SQUARE, &[(0.0, 0.0, 10.0)]), [vec![], vec![0]]);
    assert_eq!(sure(&SQUARE, &[(0.0, 0.0, 200_f64.sqrt() * 1.01)]), [vec![0]]);
}

/// Every set that a point in the clear shows must be found; every witness must show its set.
fn agrees_with_points(field: &[[f64; 2]], disks: &[(f64, f64, f64)]) {
    let scenario = scenario(field, disks);
    let found = all_sets(&scenario);
    let (index, ground) = survey(&scenario, scenario.coverage.as_ref().unwrap());
    let covering = |p: Point| -> Vec<u32> {
        let covers = |(x, y, r): &(f64, f64, f64)| (p.x - x).hypot(p.y - y) <= *r;
        (0..).zip(disks).filter(|(_, disk)| covers(disk)).map(|(i, _)| i).collect()
    };
    for i in 0..120 {
        for j in 0..120 {
            let p = Point::new(f64::from(i) / 12.0 + 0.041, f64::from(j) / 12.0 + 0.043);
            let clear = index.at(p, rounding(p)).perhaps.is_empty();
            if clear && ground.contains(p) && !ground.border_within(p, 1e-9) {
                assert!(found.contains_key(&covering(p)), "{:?} at {p}", covering(p));
            }
        }
    }
    for (set, witness) in found.iter().filter_map(|(set, at)| Some((set, (*at)?))) {
        assert_eq!(*set, covering(witness));
        assert!(ground.contains(witness));
    }
    // In general position nothing but slivers is without a witness.
    let unsure = found.values().filter(|witness| witness.is_none()).count();
    assert!(unsure * 20 <= found.len(), "{unsure} of {}", found.len());
}

const ELL: [[f64; 2]; 7] =
    [[0.0, 0.0], [10.0, 0.5], [9.0, 4.0], [4.5, 4.0], [3.0, 9.5], [1.0, 10.0], [2.0, 6.0]];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn random_disks(
        disks in prop::collection::vec((-1.0..11.0f64, -1.0..11.0f64, 0.3..5.0f64), 0..25),
    ) {
        agrees_with_points(&SQUARE, &disks);
        agrees_with_points(&ELL, &disks);
    }

    /// Coordinates in halves: tangencies, coincidences and triple points all over.
    #[test]
    fn disks_on_a_lattice(disks in prop::collection::vec((0..20u8, 0..20u8, 1..8u8), 0..20)) {
        let half = |n: u8| f64::from(n) / 2.0;
        let disks: Vec<_> = disks.iter().map(|&(x, y, r)| (half(x), half(y), half(r))).collect();
        let scenario = scenario(&SQUARE, &disks);
        let found = all_sets(&scenario);
        for i in 0..97 {
            for j in 0..97 {
                let p = Point::new(f64::from(i) / 9.71 + 0.0137, f64::from(j) / 9.71 + 0.0139);
                let near = disks.iter().any(|(x, y, r)| ((p.x - x).hypot(p.y - y) - r).abs() < 1e-9);
                let covers = |(_, (x, y, r)): &(u32, &(f64, f64, f64))| (p.x - x).hypot(p.y - y) < *r;
                let set: Vec<u32> = (0..).zip(&disks).filter(covers).map(|(i, _)| i).collect();
                prop_assert!(near || p.x > 10.0 || p.y > 10.0 || found.contains_key(&set));
            }
        }
    }
}

/// The two independent computations of coverage against each other.
fn agrees_with_the_arrangement(field: &[[f64; 2]], disks: &[(f64, f64, f64)]) {
    let scenario = scenario(field, disks);
    let walked = all_sets(&scenario);
    let regions = crate::coverage::regions(&scenario);
    for region in &regions {
        assert!(walked.contains_key(&region.covering), "not walked: {region:?} of {disks:?}");
    }
    for (set, _) in walked.iter().filter(|(_, witness)| witness.is_some()) {
        assert!(regions.iter().any(|r| r.covering == *set), "no region: {set:?} of {disks:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn random_disks_two_ways(
        disks in prop::collection::vec((-1.0..11.0f64, -1.0..11.0f64, 0.3..5.0f64), 0..25),
    ) {
        agrees_with_the_arrangement(&SQUARE, &disks);
        agrees_with_the_arrangement(&ELL, &disks);
    }

    #[test]
    fn lattice_disks_two_ways(disks in prop::collection::vec((0..20u8, 0..20u8, 1..8u8), 0..20)) {
        let half = |n: u8| f64::from(n) / 2.0;
        let disks: Vec<_> = disks.iter().map(|&(x, y, r)| (half(x), half(y), half(r))).collect();
        agrees_with_the_arrangement(&SQUARE, &disks);
    }
}
