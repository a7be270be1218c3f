//! The sensing disks and an index over them.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::scenario::{Place, Point, Scenario, Sensor};

/// A closed disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Disk {
    pub(super) centre: Point,
    pub(super) radius: f64,
}

/// The disks of all sensors, by the sensors' indices.
pub(super) struct Disks {
    all: Vec<Disk>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
}

/// Who covers a point: surely, and perhaps, their circles passing too near to tell.
#[derive(Debug, PartialEq)]
pub(super) struct Cover {
    pub(super) surely: Vec<u32>,
    pub(super) perhaps: Vec<u32>,
}

impl Disks {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let disk = |sensor: &Sensor| {
            // Under a coverage constraint every sensor is at rest and has a range.
            let centre = match &sensor.place {
                Place::Fixed(point) => *point,
                Place::Moving(trajectory) => trajectory.waypoints()[0].position_m,
            };
            Disk { centre, radius: sensor.range_m.unwrap_or(0.0) }
        };
        let all: Vec<Disk> = scenario.sensors.iter().map(disk).collect();
        let boxed = |(i, disk): (u32, &Disk)| {
            let (low, high) = disk.bounds();
            GeomWithData::new(Rectangle::from_corners(low, high), i)
        };
        let index = RTree::bulk_load((0..).zip(&all).map(boxed).collect());
        Self { all, index }
    }

    pub(super) fn get(&self, i: u32) -> Disk {
        self.all[i as usize]
    }

    pub(super) fn indices(&self) -> std::ops::Range<u32> {
        0..self.all.len() as u32
    }

    /// The disks whose bounding boxes meet a box.
    pub(super) fn near(&self, low: [f64; 2], high: [f64; 2]) -> impl Iterator<Item = u32> + '_ {
        let found = self.index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
        found.map(|boxed| boxed.data)
    }

    /// Who covers a point, by direct evaluation; `margin` says how near a circle leaves it open.
    pub(super) fn at(&self, point: Point, margin: impl Fn(Disk) -> f64) -> Cover {
        let mut cover = Cover { surely: Vec::new(), perhaps: Vec::new() };
        // Wide enough that a disk which only perhaps covers the point is not overlooked.
        let wide = 1e-5 * (1.0 + point.coords.amax());
        let low = [point.x - wide, point.y - wide];
        let high = [point.x + wide, point.y + wide];
        for i in self.near(low, high) {
            let disk = self.get(i);
            let outside = (point - disk.centre).norm() - disk.radius;
            if outside.abs() <= margin(disk) {
                cover.perhaps.push(i);
            } else if outside < 0.0 {
                cover.surely.push(i);
            }
        }
        cover.surely.sort_unstable();
        cover.perhaps.sort_unstable();
        cover
    }
}

impl Disk {
    pub(super) fn bounds(&self) -> ([f64; 2], [f64; 2]) {
        let Disk { centre, radius } = *self;
        ([centre.x - radius, centre.y - radius], [centre.x + radius, centre.y + radius])
    }
}
