//! Regions against dense sampling, and what must not change them.

use std::f64::consts::TAU;

use proptest::prelude::*;
use voltour_solver::coverage::regions;

use crate::world::{Cover, World};

/// A comb, a spiral-like hook, a triangle, a square and an octagon-like ring segment, side 20.
fn fields() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let square = vec![[0, 0], [20, 0], [20, 20], [0, 20]];
    let triangle = vec![[1, 2], [19, 5], [6, 18]];
    let comb = vec![
        [0, 0],
        [20, 0],
        [20, 20],
        [15, 20],
        [15, 5],
        [12, 5],
        [12, 20],
        [8, 20],
        [8, 5],
        [4, 5],
        [4, 20],
        [0, 20],
    ];
    let hook = vec![
        [0, 0],
        [20, 0],
        [20, 20],
        [5, 20],
        [5, 8],
        [12, 8],
        [12, 13],
        [10, 13],
        [10, 10],
        [7, 10],
        [7, 18],
        [18, 18],
        [18, 3],
        [0, 3],
    ];
    let star = vec![[10, 0], [12, 7], [20, 10], [12, 12], [10, 20], [8, 12], [0, 10], [8, 8]];
    prop::sample::select(vec![square, triangle, comb, hook, star])
        .prop_map(|corners| corners.into_iter().map(|corner| corner.map(f64::from)).collect())
}

fn random_worlds() -> impl Strategy<Value = World> {
    let disk = (-5.0..25.0, -5.0..25.0, prop_oneof![0.1..2.0, 2.0..8.0, 5.0..30.0]);
    let disks = prop::collection::vec(disk.prop_map(|(x, y, r)| [x, y, r]), 0..12);
    (fields(), disks).prop_map(|(field, disks)| World::new(&field, &disks))
}

/// Integer centres and few radii: tangencies, circles through one point, coincident sensors.
fn grid_worlds() -> impl Strategy<Value = World> {
    let disk = (-3..24, -3..24, prop::sample::select(vec![2, 3, 5, 5, 5, 10, 13]));
    let disk = disk.prop_map(|(x, y, r)| [f64::from(x), f64::from(y), f64::from(r)]);
    let disks = prop::collection::vec(disk, 0..14);
    (fields(), disks).prop_map(|(field, disks)| World::new(&field, &disks))
}

fn worlds() -> impl Strategy<Value = World> {
    prop_oneof![random_worlds(), grid_worlds()]
}

/// The sets of all sampled points in the field that keep a clearance: a lattice, and rings around
/// every crossing, computed in the plainest way.
fn sampled(world: &World) -> Cover {
    let mut points: Vec<[f64; 2]> = (0..80 * 80)
        .map(|i| [f64::from(i % 80) * 0.2507 + 0.0013, f64::from(i / 80) * 0.2509 + 0.0011])
        .collect();
    for [x, y] in crossings(world) {
        for radius in [3e-6, 1e-4, 1e-2, 0.1] {
            for step in 0..128 {
                let angle = TAU * (f64::from(step) + 0.37) / 128.0;
                points.push([x + radius * angle.cos(), y + radius * angle.sin()]);
            }
        }
    }
    let counts = |&[x, y]: &[f64; 2]| world.clearance(x, y) > 1e-6 && world.in_field(x, y);
    points.into_iter().filter(counts).map(|[x, y]| world.covering(x, y)).collect()
}

fn crossings(world: &World) -> Vec<[f64; 2]> {
    let mut points = world.field.clone();
    for (i, &[ax, ay, a]) in world.disks.iter().enumerate() {
        for &[bx, by, b] in &world.disks[..i] {
            let [dx, dy] = [bx - ax, by - ay];
            let square = dx * dx + dy * dy;
            let share = 0.5 + (a * a - b * b) / (2.0 * square);
            let height = (a * a / square - share * share).max(0.0).sqrt();
            for height in [height, -height] {
                points.push([ax + share * dx - height * dy, ay + share * dy + height * dx]);
            }
        }
        for [[px, py], [qx, qy]] in world.edges() {
            let [dx, dy] = [qx - px, qy - py];
            let square = dx * dx + dy * dy;
            let foot = ((ax - px) * dx + (ay - py) * dy) / square;
            let offset = (ax - px - foot * dx).hypot(ay - py - foot * dy);
            let reach = ((a * a - offset * offset).max(0.0) / square).sqrt();
            for share in [foot - reach, foot + reach] {
                points.push([px + share * dx, py + share * dy]);
            }
        }
    }
    points.retain(|point| point.iter().all(|x| x.is_finite()));
    points
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn random_disks_leave_no_sampled_set_out(world in random_worlds()) {
        let sets = world.sets();
        let missing: Vec<_> = sampled(&world).difference(&sets).cloned().collect();
        prop_assert!(missing.is_empty(), "missing {missing:?}");
    }

    #[test]
    fn grid_disks_have_exactly_the_sampled_sets(world in grid_worlds()) {
        // The crossings of these are far apart or coincide, so that the rings meet every face.
        prop_assert_eq!(world.sets(), sampled(&world));
    }

    #[test]
    fn same_regions_after_a_translation(world in worlds(), by in prop::array::uniform2(-40..40)) {
        let [east, north] = by.map(|steps| f64::from(steps) * 64.0);
        let mut moved = world.clone();
        moved.field.iter_mut().for_each(|[x, y]| (*x, *y) = (*x + east, *y + north));
        moved.disks.iter_mut().for_each(|[x, y, _]| (*x, *y) = (*x + east, *y + north));
        prop_assert_eq!(world.sets(), moved.sets());
    }

    #[test]
    fn same_regions_after_a_quarter_turn(world in worlds()) {
        let mut turned = world.clone();
        turned.field.iter_mut().for_each(|[x, y]| (*x, *y) = (-*y, *x));
        turned.disks.iter_mut().for_each(|[x, y, _]| (*x, *y) = (-*y, *x));
        prop_assert_eq!(world.sets(), turned.sets());
    }

    #[test]
    fn same_regions_after_relabelling(world in worlds(), turn in 0usize..12) {
        let mut renamed = world.clone();
        let n = renamed.disks.len();
        let turn = turn % n.max(1);
        renamed.disks.rotate_left(turn);
        let rename = |set: &Vec<u32>| {
            let mut set: Vec<_> = set.iter().map(|&i| ((i as usize + n - turn) % n) as u32).collect();
            set.sort_unstable();
            set
        };
        prop_assert_eq!(world.sets().iter().map(rename).collect::<Cover>(), renamed.sets());
    }

    #[test]
    fn same_scenario_same_regions_in_the_same_order(world in worlds()) {
        prop_assert_eq!(regions(&world.scenario()), regions(&world.scenario()));
    }
}
