//! The distinct sensing disks that reach the field, in local coordinates, with an index over them.
//! Sensors that share centre and range are one disk: their circles would coincide everywhere.

use std::collections::BTreeMap;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::border::Border;
use super::frame::Frame;
use crate::scenario::{Place, Point, Scenario, Sensor};

/// A closed disk and the sensors that sense exactly it.
pub(super) struct Disk {
    pub(super) centre: Point,
    pub(super) range: f64,
    /// Rising indices into the scenario's sensors, at least one.
    pub(super) sensors: Vec<u32>,
}

/// Every disk that reaches the field, in an order that keeps neighbours together.
pub(super) struct Disks {
    disks: Vec<Disk>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
}

impl Disks {
    pub(super) fn new(sensors: &[Sensor], frame: &Frame, border: &Border) -> Self {
        let mut disks: Vec<Disk> = Vec::with_capacity(sensors.len());
        let mut known = BTreeMap::new();
        for (i, sensor) in (0..).zip(sensors) {
            // The format gives every sensor a place and a range where there is a coverage constraint.
            let (Place::Fixed(place), Some(range)) = (&sensor.place, sensor.range_m) else {
                continue;
            };
            // Adding zero makes -0.0 and 0.0 the same key.
            let key = [place.x + 0.0, place.y + 0.0, range].map(f64::to_bits);
            let at = *known.entry(key).or_insert(disks.len());
            match disks.get_mut(at) {
                Some(disk) => disk.sensors.push(i),
                None => disks.push(Disk { centre: frame.local(*place), range, sensors: vec![i] }),
            }
        }
        disks.retain(|disk| border.boxes(disk.centre, disk.range));
        // Neighbours in the plane are handled one after the other, while their faces are in the cache.
        disks.sort_by_cached_key(|disk| morton(disk.centre, border));
        let boxed = |(i, disk): (u32, &Disk)| {
            let (Point { coords: c }, r) = (disk.centre, disk.range);
            GeomWithData::new(Rectangle::from_corners([c.x - r, c.y - r], [c.x + r, c.y + r]), i)
        };
        let index = RTree::bulk_load((0..).zip(&disks).map(boxed).collect());
        Self { disks, index }
    }

    pub(super) fn len(&self) -> usize {
        self.disks.len()
    }

    pub(super) fn get(&self, i: u32) -> &Disk {
        &self.disks[i as usize]
    }

    /// The disks within a distance of a point, rising.
    pub(super) fn near(&self, point: Point, distance: f64) -> Vec<u32> {
        let low = [point.x - distance, point.y - distance];
        let high = [point.x + distance, point.y + distance];
        let near = self.index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
        let close = |&i: &u32| (self.get(i).centre - point).norm() <= self.get(i).range + distance;
        let mut near: Vec<u32> = near.map(|hit| hit.data).filter(close).collect();
        near.sort_unstable();
        near
    }

    /// The sensors of a set of disks, rising.
    pub(super) fn sensors(&self, set: &[u32]) -> Vec<u32> {
        let mut sensors = Vec::with_capacity(set.len());
        sensors.extend(set.iter().flat_map(|&disk| &self.get(disk).sensors));
        sensors.sort_unstable();
        sensors
    }
}

/// The place of a point along the Z-order curve over the field.
fn morton(point: Point, border: &Border) -> u32 {
    const CELLS: f64 = 1024.0;
    let cell = (point - border.low) * (CELLS / border.extent());
    let spread = |x: f64| {
        // The cast saturates: points beyond the field count to its edge.
        let x = x.min(CELLS - 1.0) as u32;
        (0..10).fold(0, |spread, bit| spread | (x >> bit & 1) << (2 * bit))
    };
    spread(cell.x) | spread(cell.y) << 1
}

/// Everything that the arrangement is made of.
pub(super) struct Curves {
    pub(super) frame: Frame,
    pub(super) border: Border,
    pub(super) disks: Disks,
}

impl Curves {
    /// `None` without a coverage constraint.
    pub(super) fn of(scenario: &Scenario) -> Option<Self> {
        let field = &scenario.coverage.as_ref()?.field;
        let frame = Frame::of(field);
        let border = Border::new(field, &frame);
        let disks = Disks::new(&scenario.sensors, &frame, &border);
        Some(Self { frame, border, disks })
    }
}
