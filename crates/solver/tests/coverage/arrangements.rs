//! Arrangements whose regions are known by hand.

use voltour_solver::coverage::{below_k, regions, shortfalls};

use crate::world::{World, cover};

/// A U: the notch is [4, 6] x [2, 10].
const U: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [10.0, 0.0],
    [10.0, 10.0],
    [6.0, 10.0],
    [6.0, 2.0],
    [4.0, 2.0],
    [4.0, 10.0],
    [0.0, 10.0],
];

#[test]
fn no_sensor_leaves_one_empty_region() {
    assert_eq!(World::square(10.0, &[]).sets(), cover(&[&[]]));
    assert_eq!(World::new(&U, &[]).sets(), cover(&[&[]]));
}

#[test]
fn no_coverage_constraint_has_no_regions() {
    let mut scenario = World::square(10.0, &[[5.0, 5.0, 2.0]]).scenario();
    scenario.coverage = None;
    assert!(regions(&scenario).is_empty());
}

#[test]
fn disk_inside_the_field_and_across_its_border() {
    assert_eq!(World::square(10.0, &[[5.0, 5.0, 2.0]]).sets(), cover(&[&[], &[0]]));
    assert_eq!(World::square(10.0, &[[0.0, 5.0, 2.0]]).sets(), cover(&[&[], &[0]]));
    assert_eq!(World::square(10.0, &[[0.0, 0.0, 2.0]]).sets(), cover(&[&[], &[0]]));
    assert_eq!(World::square(10.0, &[[-1.0, 5.0, 1.5]]).sets(), cover(&[&[], &[0]]));
}

#[test]
fn disk_over_the_whole_field_leaves_no_empty_region() {
    assert_eq!(World::square(10.0, &[[5.0, 5.0, 8.0]]).sets(), cover(&[&[0]]));
    let with_another = World::square(10.0, &[[5.0, 5.0, 8.0], [5.0, 5.0, 1e6], [3.0, 3.0, 1.0]]);
    assert_eq!(with_another.sets(), cover(&[&[0, 1], &[0, 1, 2]]));
    // Its circle runs through all four corners.
    assert_eq!(World::square(14.0, &[[7.0, 7.0, 98_f64.sqrt() + 1e-15]]).sets(), cover(&[&[0]]));
}

#[test]
fn disks_outside_the_field_have_no_region() {
    let far = [[-5.0, 5.0, 2.0], [100.0, 100.0, 3.0], [-1.5, -1.5, 2.0]];
    assert_eq!(World::square(10.0, &far).sets(), cover(&[&[]]));
    // In the notch of the U: within its bounding box, outside the field.
    assert_eq!(World::new(&U, &[[5.0, 7.0, 0.5]]).sets(), cover(&[&[]]));
}

#[test]
fn disk_from_the_notch_reaches_both_arms() {
    let world = World::new(&U, &[[5.0, 7.0, 1.5], [2.0, 7.0, 1.8]]);
    assert_eq!(world.sets(), cover(&[&[], &[0], &[1], &[0, 1]]));
}

#[test]
fn two_disks_cross() {
    let world = World::square(10.0, &[[4.0, 5.0, 2.0], [6.0, 5.0, 2.5]]);
    assert_eq!(world.sets(), cover(&[&[], &[0], &[1], &[0, 1]]));
}

#[test]
fn disks_inside_disks_without_crossings() {
    let nested = [[5.0, 5.0, 4.0], [5.5, 5.0, 2.0], [5.5, 5.2, 1.0], [5.0, 5.0, 3.5]];
    let sets = cover(&[&[], &[0], &[0, 3], &[0, 1, 3], &[0, 1, 2, 3]]);
    assert_eq!(World::square(10.0, &nested).sets(), sets);
}

#[test]
fn disks_that_touch_from_outside_share_no_region() {
    let beside = World::square(20.0, &[[5.0, 10.0, 5.0], [15.0, 10.0, 5.0]]);
    assert_eq!(beside.sets(), cover(&[&[], &[0], &[1]]));
    // The same with a slanted axis: the centres are 5 apart.
    let slanted = World::square(20.0, &[[7.0, 7.0, 2.0], [10.0, 11.0, 3.0]]);
    assert_eq!(slanted.sets(), cover(&[&[], &[0], &[1]]));
}

#[test]
fn disks_that_touch_from_inside_leave_a_crescent() {
    let world = World::square(20.0, &[[10.0, 10.0, 8.0], [13.0, 14.0, 3.0]]);
    assert_eq!(world.sets(), cover(&[&[], &[0], &[0, 1]]));
}

#[test]
fn disk_that_touches_the_border() {
    assert_eq!(World::square(10.0, &[[3.0, 5.0, 3.0]]).sets(), cover(&[&[], &[0]]));
    assert_eq!(World::square(10.0, &[[-3.0, 5.0, 3.0]]).sets(), cover(&[&[]]));
    assert_eq!(World::square(10.0, &[[5.0, 5.0, 5.0]]).sets(), cover(&[&[], &[0]]));
}

#[test]
fn coincident_sensors_are_covered_together() {
    let twins = [[5.0, 5.0, 2.0], [6.0, 5.0, 2.0], [5.0, 5.0, 2.0], [5.0, 5.0, 2.0]];
    let sets = cover(&[&[], &[1], &[0, 2, 3], &[0, 1, 2, 3]]);
    assert_eq!(World::square(10.0, &twins).sets(), sets);
    let zeros = World::square(10.0, &[[0.0, 5.0, 2.0], [-0.0, 5.0, 2.0]]);
    assert_eq!(zeros.sets(), cover(&[&[], &[0, 1]]));
}

#[test]
fn three_circles_through_one_point() {
    // All pass through (10, 10), where six sectors meet; far from it they cross in pairs.
    let world = World::square(20.0, &[[7.0, 6.0, 5.0], [13.0, 6.0, 5.0], [10.0, 15.0, 5.0]]);
    let sets = cover(&[&[], &[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2]]);
    assert_eq!(world.sets(), sets);
}

#[test]
fn four_circles_through_one_point_tangent_in_pairs() {
    let world = World::square(
        20.0,
        &[[5.0, 10.0, 5.0], [15.0, 10.0, 5.0], [10.0, 5.0, 5.0], [10.0, 15.0, 5.0]],
    );
    let sets = cover(&[&[], &[0], &[1], &[2], &[3], &[0, 2], &[0, 3], &[1, 2], &[1, 3]]);
    assert_eq!(world.sets(), sets);
}

#[test]
fn ring_of_touching_disks_around_a_star() {
    // Four disks touch in a ring inside a fifth that contains them; a sixth fills the star between
    // them and passes through their four tangent points.
    let ring = [[7.0, 7.0, 3.0], [13.0, 7.0, 3.0], [13.0, 13.0, 3.0], [7.0, 13.0, 3.0]];
    let mut disks = ring.to_vec();
    disks.extend([[10.0, 10.0, 9.0], [10.0, 10.0, 3.0]]);
    let sets = cover(&[
        &[],
        &[4],
        &[0, 4],
        &[1, 4],
        &[2, 4],
        &[3, 4],
        &[4, 5],
        &[0, 4, 5],
        &[1, 4, 5],
        &[2, 4, 5],
        &[3, 4, 5],
    ]);
    assert_eq!(World::square(20.0, &disks).sets(), sets);
}

#[test]
fn circle_through_a_corner_of_the_field() {
    // (0, 0) is on the circle; the disk's inside holds the corner's surroundings only in part.
    let world = World::square(10.0, &[[3.0, 4.0, 5.0]]);
    assert_eq!(world.sets(), cover(&[&[], &[0]]));
    let outside = World::square(10.0, &[[-3.0, -4.0, 5.0]]);
    assert_eq!(outside.sets(), cover(&[&[]]));
}

#[test]
fn collinear_corners_and_either_orientation() {
    let field = [[0.0, 0.0], [0.0, 5.0], [0.0, 10.0], [10.0, 10.0], [10.0, 0.0], [4.0, 0.0]];
    let world = World::new(&field, &[[0.0, 5.0, 2.0], [4.0, 0.0, 1.0]]);
    assert_eq!(world.sets(), cover(&[&[], &[0], &[1]]));
}

#[test]
fn thin_lens_and_small_triangle_are_found() {
    let lens = World::square(20.0, &[[5.0, 10.0, 5.0], [15.0, 10.0, 5.0 + 1e-9]]);
    assert_eq!(lens.sets(), cover(&[&[], &[0], &[1], &[0, 1]]));
    // The third circle passes 1e-8 m beside the crossing (10, 10) of the first two.
    let disks = [[7.0, 6.0, 5.0], [13.0, 6.0, 5.0], [10.0, 15.0, 5.0 + 1e-8]];
    let triangle = World::square(20.0, &disks);
    let sets = cover(&[&[], &[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2], &[0, 1, 2]]);
    assert_eq!(triangle.sets(), sets);
}

#[test]
fn nearly_coincident_circles_leave_long_slivers() {
    let shifts = [[3, 1], [-2, 4], [-5, -1], [1, -6], [7, -2], [-4, -7], [6, 6], [-8, 3]]
        .map(|s| s.map(f64::from));
    // Seen from afar, a direction ranks the circles by how far they are shifted that way, and the
    // slivers from outside to inside are covered by the first, the first two, and so on.
    let mut sets = cover(&[&[]]);
    for step in 0..36_000 {
        let (sin, cos) = (f64::from(step) * 0.01).to_radians().sin_cos();
        let mut ranking: Vec<u32> = (0..8).collect();
        let reach = |&i: &u32| -shifts[i as usize][0] * cos - shifts[i as usize][1] * sin;
        ranking.sort_by(|a, b| reach(a).total_cmp(&reach(b)));
        for covers in 1..=8 {
            let mut set = ranking[..covers].to_vec();
            set.sort_unstable();
            sets.insert(set);
        }
    }
    for unit in [1e-3, 1e-5, 1e-7, 1e-9] {
        let disks = shifts.map(|[x, y]| [250.0 + unit * x, 250.0 + unit * y, 100.0]);
        assert_eq!(World::square(500.0, &disks).sets(), sets, "shifted by {unit}");
    }
}

#[test]
fn sliver_that_is_wide_enough_only_far_from_its_ends() {
    // Inside the circles of 0 and 3, outside those of 1 and 2: up to 1e-7 m wide over tens of metres.
    let disks = [
        [250.0000233285937, 250.000015935717, 100.000001],
        [249.9999998465349, 249.9999996041578, 100.0],
        [249.99999946547237, 249.99999895935758, 100.000001],
        [249.9999999883435, 249.99999999949148, 100.0],
    ];
    let world = World::square(500.0, &disks);
    assert_eq!(world.covering(294.91395544570867, 339.34616154185056), [0, 3]);
    assert!(world.sets().contains(&vec![0, 3]));
}

#[test]
fn triangular_lattice_where_six_circles_meet_in_every_vertex() {
    // Neighbours are a range apart. Between three of them lies a region that only they cover, on the
    // way from one to the next a petal that these two cover and the two to either side.
    let place = |column: i32, row: i32| {
        let (x, y) = (f64::from(column) + 0.5 * f64::from(row), f64::from(row) * 0.75_f64.sqrt());
        [x * 4.0, y * 4.0]
    };
    let lattice: Vec<_> =
        (-2..9).flat_map(|row| (-6..9).map(move |column| (column, row))).collect();
    let disks: Vec<_> = lattice.iter().map(|&(c, r)| (place(c, r), 4.0)).collect();
    let disks: Vec<_> = disks.into_iter().map(|([x, y], range)| [x, y, range]).collect();
    let sets = World::square(20.0, &disks).sets();
    let mut seen = 0;
    for &(c, r) in &lattice {
        let up = vec![(c, r), (c + 1, r), (c, r + 1)];
        let down = vec![(c + 1, r), (c, r + 1), (c + 1, r + 1)];
        let petal = vec![(c + 1, r), (c, r + 1), (c, r), (c + 1, r + 1)];
        for corners in [up, down, petal] {
            let middle = corners.iter().map(|&(c, r)| place(c, r)).fold([0.0; 2], |sum, [x, y]| {
                [sum[0] + x / corners.len() as f64, sum[1] + y / corners.len() as f64]
            });
            if middle.iter().all(|x| (0.5..19.5).contains(x)) {
                let index = |corner| lattice.iter().position(|other| other == corner);
                let set: Option<Vec<_>> = corners.iter().map(|c| Some(index(c)? as u32)).collect();
                let mut set = set.expect("the lattice reaches beyond the field");
                set.sort_unstable();
                assert!(sets.contains(&set), "{corners:?} is missing");
                seen += 1;
            }
        }
    }
    assert!(seen > 60, "{seen}");
    assert!(sets.iter().all(|set| set.len() == 3 || set.len() == 4), "{sets:?}");
}

#[test]
fn small_triangle_far_from_the_origin() {
    const FAR: f64 = 1_048_576.0;
    let field = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
    let disks = [[7.0, 6.0, 5.0], [13.0, 6.0, 5.0], [10.0, 15.0, 5.0 + 1e-8]];
    let field = field.map(|[x, y]| [x + FAR, y - FAR]);
    let sets = World::new(&field, &disks.map(|[x, y, r]| [x + FAR, y - FAR, r])).sets();
    assert_eq!(sets.len(), 8, "{sets:?}");
}

#[test]
fn specks_are_ignored() {
    let disks = [[7.0, 6.0, 5.0], [13.0, 6.0, 5.0], [10.0, 15.0, 5.0 + 2e-10]];
    let sets = World::square(20.0, &disks).sets();
    assert!(!sets.contains(&vec![0, 1, 2]), "{sets:?}");
    assert_eq!(sets.len(), 7);
}

#[test]
fn small_large_and_distant_fields() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let disks = [[0.35, 0.3, 0.25], [0.65, 0.3, 0.25], [0.5, 0.75, 0.25], [0.5, 0.45, 0.3]];
    let expected = World::new(&square, &disks).sets();
    assert!(expected.len() > 8, "{expected:?}");
    for (scale, east, north) in
        [(1e5, 0.0, 0.0), (1.0, 1e6, -3e6), (500.0, 4.5e5, 0.0), (1e5, -2e7, 5e6), (1e-3, 0.0, 0.0)]
    {
        let field = square.map(|[x, y]| [x * scale + east, y * scale + north]);
        let disks = disks.map(|[x, y, r]| [x * scale + east, y * scale + north, r * scale]);
        assert_eq!(World::new(&field, &disks).sets(), expected, "{scale} {east} {north}");
    }
}

#[test]
fn shortfalls_count_what_is_kept() {
    let mut world = World::square(10.0, &[[4.0, 5.0, 2.0], [6.0, 5.0, 2.0], [5.0, 5.0, 9.0]]);
    world.k = 2;
    world.requests = vec![(1, false), (0, true), (2, false)];
    let scenario = world.scenario();
    let found = regions(&scenario);
    let short = |served: &[usize]| {
        let short = shortfalls(&scenario, &found, |request| served.contains(&request));
        let mut short: Vec<_> =
            short.iter().map(|s| (s.region.covering.clone(), s.needs, s.has)).collect();
        short.sort();
        short
    };
    assert_eq!(short(&[0, 2]), []);
    assert_eq!(short(&[2]), [(vec![1, 2], 2, 1)]);
    let none = [(vec![0, 1, 2], 2, 1), (vec![0, 2], 2, 1), (vec![1, 2], 2, 0), (vec![2], 1, 0)];
    assert_eq!(short(&[]), none);
    let warned: Vec<_> =
        below_k(&scenario, &found).iter().map(|s| (&s.region.covering, s.needs, s.has)).collect();
    assert_eq!(warned, [(&vec![2], 2, 1)]);
}
