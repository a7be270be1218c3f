//! Small scenarios from a field, disks and requests, and the oracles that judge their regions.

use std::collections::BTreeSet;

use voltour_solver::coverage::{Region, regions};
use voltour_solver::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, Objective, RequestDocument, Scenario,
    SensorDocument,
};

/// A field, disks `[x, y, range]`, and which sensors ask to be charged.
#[derive(Clone, Debug)]
pub struct World {
    pub field: Vec<[f64; 2]>,
    pub disks: Vec<[f64; 3]>,
    pub k: u32,
    /// Sensor, and whether its request is already charged.
    pub requests: Vec<(usize, bool)>,
}

pub type Cover = BTreeSet<Vec<u32>>;

impl World {
    pub fn new(field: &[[f64; 2]], disks: &[[f64; 3]]) -> Self {
        Self { field: field.to_vec(), disks: disks.to_vec(), k: 1, requests: Vec::new() }
    }

    /// On the field [0, side] x [0, side].
    pub fn square(side: f64, disks: &[[f64; 3]]) -> Self {
        Self::new(&[[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]], disks)
    }

    pub fn scenario(&self) -> Scenario {
        let sensor = |(i, [x, y, range]): (usize, &[f64; 3])| SensorDocument {
            id: format!("s{i}"),
            position_m: Some([*x, *y]),
            trajectory: None,
            range_m: Some(*range),
            battery_j: 10.0,
        };
        let request = |&(sensor, charged): &(usize, bool)| RequestDocument {
            sensor: format!("s{sensor}"),
            ready_s: None,
            deadline_s: None,
            residual_j: Some(if charged { 10.0 } else { 1.0 }),
            drain_w: None,
            reward: None,
            required: Some(sensor % 2 == 0),
        };
        let document = Document {
            format: FORMAT.into(),
            name: None,
            objective: Objective::MinDistance,
            charger: ChargerDocument {
                start_m: [0.0, 0.0],
                end_m: None,
                speed_mps: 5.0,
                travel_jpm: 600.0,
                transfer_w: 20.0,
                capacity_j: None,
                timespan_s: None,
            },
            charge_level: None,
            coverage: Some(CoverageDocument { k: f64::from(self.k), field_m: self.field.clone() }),
            sensors: self.disks.iter().enumerate().map(sensor).collect(),
            requests: self.requests.iter().map(request).collect(),
            travel: None,
        };
        Scenario::from_document(&document).expect("a valid scenario")
    }

    /// The sets of the regions, after each region was judged by itself.
    pub fn sets(&self) -> Cover {
        let regions = regions(&self.scenario());
        self.judge(&regions);
        let sets: Cover = regions.iter().map(|region| region.covering.clone()).collect();
        assert_eq!(sets.len(), regions.len(), "a set appears twice");
        sets
    }

    /// Each witness is in the field and covered by exactly the sensors that its region names.
    pub fn judge(&self, regions: &[Region]) {
        for region in regions {
            let [x, y] = [region.witness.x, region.witness.y];
            assert!(self.in_field(x, y), "{region:?} has its witness outside the field");
            assert_eq!(self.covering(x, y), region.covering, "recomputed at {}", region.witness);
        }
    }

    pub fn covering(&self, x: f64, y: f64) -> Vec<u32> {
        let covers = |[cx, cy, range]: &[f64; 3]| (x - cx).hypot(y - cy) <= *range;
        (0..).zip(&self.disks).filter(|(_, disk)| covers(disk)).map(|(i, _)| i).collect()
    }

    /// Crossing number of a ray upwards; the library's ray runs to the right.
    pub fn in_field(&self, x: f64, y: f64) -> bool {
        let crossed = |[[ax, ay], [bx, by]]: [[f64; 2]; 2]| {
            (ax > x) != (bx > x) && y < ay + (by - ay) * (x - ax) / (bx - ax)
        };
        self.edges().filter(|edge| crossed(*edge)).count() % 2 == 1
    }

    /// Distance of the nearest circle or edge.
    pub fn clearance(&self, x: f64, y: f64) -> f64 {
        let circle = |[cx, cy, range]: &[f64; 3]| ((x - cx).hypot(y - cy) - range).abs();
        let edge = |[[ax, ay], [bx, by]]: [[f64; 2]; 2]| {
            let [dx, dy] = [bx - ax, by - ay];
            let share = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy);
            let share = share.clamp(0.0, 1.0);
            (x - ax - share * dx).hypot(y - ay - share * dy)
        };
        let circles = self.disks.iter().map(circle);
        circles.chain(self.edges().map(edge)).fold(f64::INFINITY, f64::min)
    }

    pub fn edges(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        let n = self.field.len();
        (0..n).map(move |i| [self.field[i], self.field[(i + 1) % n]])
    }
}

/// The sets as a test writes them down.
pub fn cover(sets: &[&[u32]]) -> Cover {
    sets.iter().map(|set| set.to_vec()).collect()
}
