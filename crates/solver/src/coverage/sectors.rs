//! What lies around a vertex. In general position two curves cross there and the sets of the sectors
//! follow from the disks around them; elsewhere (several curves through one point, tangencies,
//! corners of the field) small circles around the vertex are walked from curve to curve.

use std::f64::consts::TAU;

use super::border::Edge;
use super::disks::Curves;
use super::surroundings::Surroundings;
use crate::scenario::Point;

/// The curves at a vertex, and its scratch space.
#[derive(Default)]
pub(super) struct Sectors {
    /// The disks that contain the vertex in their interior, rising.
    pub(super) covering: Vec<u32>,
    /// The disks whose circles pass through it, rising.
    pub(super) touching: Vec<u32>,
    /// How many edges of the field pass through it; two at a corner.
    pub(super) edges: usize,
    /// The distance of the nearest curve that does not, at most the reach of the surroundings.
    pub(super) gap: f64,
    offsets: Vec<f64>,
    probed: Vec<f64>,
    angles: Vec<f64>,
    set: Vec<u32>,
}

impl Sectors {
    /// Sorts the curves near a vertex into those that contain it, pass through it, or neither.
    pub(super) fn survey(&mut self, near: &Surroundings, vertex: Point) {
        near.offsets(vertex, &mut self.offsets);
        near.covering(&self.offsets, &mut self.covering);
        self.touching.clear();
        self.edges = 0;
        self.gap = near.reach;
        for (i, &offset) in self.offsets.iter().enumerate() {
            if offset.abs() <= near.tolerance_of(i) {
                self.touching.push(near.disks[i]);
            } else {
                self.gap = self.gap.min(offset.abs());
            }
        }
        for disk in &self.touching {
            if let Ok(at) = self.covering.binary_search(disk) {
                self.covering.remove(at);
            }
        }
        for edge in &near.edges {
            let distance = edge.distance(vertex);
            if distance <= near.tolerance {
                self.edges += 1;
            } else {
                self.gap = self.gap.min(distance);
            }
        }
    }

    /// Whether at most two curves meet, of which at most one is an edge: then every set of the
    /// sectors is `covering` with some of `touching`.
    pub(super) fn is_simple(&self) -> bool {
        self.edges < 2 && self.touching.len() + self.edges <= 2
    }

    /// Calls `found` with a point, its covering disks and its depth for every sector of the circle of
    /// that radius around a surveyed vertex; sectors outside the field or too thin to hold a point
    /// are left out.
    pub(super) fn probe(
        &mut self,
        curves: &Curves,
        near: &Surroundings,
        vertex: Point,
        radius: f64,
        mut found: impl FnMut(Point, &[u32], f64),
    ) {
        self.mark_crossings(near, vertex, radius);
        self.angles.sort_unstable_by(f64::total_cmp);
        let first = self.angles.first().copied().unwrap_or(0.0);
        self.angles.push(first + TAU);
        let mut last = self.angles[0];
        for i in 0..self.angles.len() {
            let next = self.angles[i];
            // Without any crossing there is one angle, and the whole turn is its sector.
            if next > last || self.angles.len() == 1 {
                let (sin, cos) = (last + 0.5 * (next - last)).sin_cos();
                let point = Point::new(vertex.x + radius * cos, vertex.y + radius * sin);
                let point = curves.frame.representable(point);
                let depth = near.locate(curves, point, &mut self.probed, &mut self.set);
                if let Some(depth) = depth {
                    found(point, &self.set, depth);
                }
            }
            last = next;
        }
    }

    /// The angles at which a curve crosses the circle around the vertex, in [0, TAU).
    fn mark_crossings(&mut self, near: &Surroundings, vertex: Point, radius: f64) {
        self.angles.clear();
        for (i, &offset) in self.offsets.iter().enumerate() {
            let (dx, dy) = (near.x[i] - vertex.x, near.y[i] - vertex.y);
            let distance = offset + near.range[i];
            // The law of cosines, in a form that keeps its digits where the radius is small.
            let cos =
                (offset * (distance + near.range[i]) + radius * radius) / (2.0 * distance * radius);
            if cos.abs() <= 1.0 {
                mark(&mut self.angles, dy.atan2(dx), cos.acos());
            }
        }
        for edge in &near.edges {
            let cos = -edge.offset(vertex) / radius;
            if cos.abs() <= 1.0 && edge.distance(vertex) <= radius {
                mark(&mut self.angles, normal_angle(edge), cos.acos());
            }
        }
    }
}

fn mark(angles: &mut Vec<f64>, middle: f64, half: f64) {
    angles.extend([middle - half, middle + half].map(|angle| angle.rem_euclid(TAU)));
}

/// The direction to the left of an edge.
fn normal_angle(edge: &Edge) -> f64 {
    let along = edge.to - edge.from;
    along.x.atan2(-along.y)
}
