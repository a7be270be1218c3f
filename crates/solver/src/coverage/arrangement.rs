//! The vertices of the arrangement, each handed to whoever classifies the faces around it.

use super::Region;
use super::crossings::{Circle, circle_circle, circle_edge};
use super::disks::Curves;
use super::faces::Faces;
use super::sectors::Sectors;
use super::sets::Sets;
use super::surroundings::Surroundings;
use crate::scenario::{Point, Scenario};

/// Where the three points of a circle lie that stand for it where nothing crosses it. Not on an axis,
/// where deployments on a grid would make them coincide with crossings.
const LONE_ANGLES: [f64; 3] = [0.3, 2.4, 4.5];
/// From one probing circle to the next smaller one.
const SHRINK: f64 = 1.0 / 16.0;
/// Metres: the gap around a vertex below which other curves crowd it.
const CROWDED: f64 = 1e-6;
/// Metres: vertices nearer than this with the same curves are one.
const CLUSTER: f64 = 1e-9;

/// Every distinct region of the scenario's coverage constraint, in a fixed order; empty without one.
///
/// Every face of the arrangement has a vertex on its border, or a whole circle, so the sectors around
/// the vertices and around a few points of each circle show the sets of all faces.
pub fn regions(scenario: &Scenario) -> Vec<Region> {
    let Some(curves) = Curves::of(scenario) else { return Vec::new() };
    let disks = 0..curves.disks.len() as u32;
    let around: Vec<_> = disks.clone().map(|i| Surroundings::of_disk(&curves, i)).collect();
    let mut vertices = Vertices::default();
    for i in disks {
        let near = &around[i as usize];
        let circle = circle(&curves, i);
        for &j in near.disks.iter().filter(|&&j| j > i) {
            let other = &around[j as usize];
            let disk = if other.disks.len() < near.disks.len() { j } else { i };
            for vertex in circle_circle(circle, self::circle(&curves, j)) {
                vertices.visit(&curves, &around, vertex, disk);
            }
        }
        for edge in &near.edges {
            for vertex in circle_edge(circle, edge, near.tolerance) {
                vertices.visit(&curves, &around, vertex, i);
            }
        }
        for vertex in lone_points(circle) {
            vertices.visit(&curves, &around, vertex, i);
        }
    }
    for corner in curves.border.corners() {
        let near = Surroundings::of_point(&curves, corner);
        vertices.sectors.survey(&near, corner);
        vertices.probe(&curves, &near, corner);
    }
    let mut faces = vertices.faces;
    faces.settle(&curves, &around);
    faces.into_regions(&curves)
}

fn circle(curves: &Curves, disk: u32) -> Circle {
    let disk = curves.disks.get(disk);
    (disk.centre, disk.range)
}

fn lone_points((centre, range): Circle) -> [Point; 3] {
    LONE_ANGLES.map(|angle| {
        let (sin, cos) = angle.sin_cos();
        Point::new(centre.x + range * cos, centre.y + range * sin)
    })
}

/// The vertices so far: the faces that they show, and the clusters already probed.
#[derive(Default)]
struct Vertices {
    faces: Faces,
    sectors: Sectors,
    clusters: Sets,
}

impl Vertices {
    /// Classifies the faces around a vertex on a disk's circle.
    fn visit(&mut self, curves: &Curves, around: &[Surroundings], vertex: Point, disk: u32) {
        let near = &around[disk as usize];
        if !curves.border.boxes(vertex, near.tolerance) {
            return;
        }
        self.sectors.survey(near, vertex);
        if self.sectors.edges == 0 && !near.in_field(curves, vertex) {
            return;
        }
        if self.sectors.is_simple() {
            self.faces.claim(vertex, disk, &self.sectors);
        } else if self.is_new_cluster(near, vertex) {
            self.probe(curves, near, vertex);
        }
    }

    /// Probes circles of all sizes around a surveyed vertex, down to where the curves through it
    /// cannot be told apart: from the nearest curve that does not pass through it, or from afar where
    /// that one is so near that it may be nearly parallel.
    fn probe(&mut self, curves: &Curves, near: &Surroundings, vertex: Point) {
        let Self { faces, sectors, .. } = self;
        let smallest = CLUSTER.max(4.0 * near.tolerance);
        let clear = if sectors.gap > CROWDED { sectors.gap } else { near.reach };
        let mut radius = (0.5 * clear).max(smallest);
        while radius >= smallest {
            let found = |at, set: &[u32], depth| faces.large(at, set, depth);
            sectors.probe(curves, near, vertex, radius, found);
            radius *= SHRINK;
        }
    }

    /// Where m curves meet there are m (m - 1) / 2 crossings; one of them is enough.
    fn is_new_cluster(&mut self, near: &Surroundings, vertex: Point) -> bool {
        let cell = CLUSTER.max(16.0 * near.tolerance);
        let [x, y] = [vertex.x, vertex.y].map(|x| (x / cell).round().to_bits());
        let place = [x, x >> 32, y, y >> 32].map(|half| half as u32);
        let known = self.clusters.len();
        let key = [&place[..], &self.sectors.touching].concat();
        self.clusters.intern(&key) as usize == known
    }
}
