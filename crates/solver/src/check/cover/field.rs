//! The field of interest: what is inside, and where circles cross its border.

use crate::scenario::{Point, Polygon};

use super::disks::Disk;

/// The field; corners counter-clockwise.
pub(super) struct Field<'a> {
    corners: &'a [Point],
}

impl<'a> Field<'a> {
    pub(super) fn new(polygon: &'a Polygon) -> Self {
        Self { corners: polygon.corners() }
    }

    /// The edges, each with the field on its left.
    pub(super) fn edges(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(a, b)| (*a, *b))
    }

    /// Even-odd rule along a ray to the right.
    pub(super) fn contains(&self, p: Point) -> bool {
        let crossings = self.edges().filter(|(a, b)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))
        });
        crossings.count() % 2 == 1
    }

    /// Whether the border passes within `margin` of a point.
    pub(super) fn border_within(&self, p: Point, margin: f64) -> bool {
        self.edges().any(|(a, b)| {
            let edge = b - a;
            let share = (edge.dot(&(p - a)) / edge.norm_squared()).clamp(0.0, 1.0);
            (p - (a + edge * share)).norm() <= margin
        })
    }

    /// Angles at which a circle crosses or touches the border, rising, in (-pi, pi]. Some may lie
    /// a little beyond the end of an edge: they serve to cut the circle, and a cut too many is harmless.
    pub(super) fn cuts(&self, disk: Disk) -> Vec<f64> {
        let Disk { centre, radius } = disk;
        let mut cuts = Vec::new();
        for (a, b) in self.edges() {
            let length = (b - a).norm();
            let along = (b - a) / length;
            let foot = along.dot(&(centre - a));
            let height = along.perp(&(centre - a)).abs();
            let grace = 1e-9 * radius;
            if height > radius + grace {
                continue;
            }
            let half = ((radius - height) * (radius + height)).max(0.0).sqrt();
            for at in [foot - half, foot + half] {
                if at >= -grace && at <= length + grace {
                    let to = a + along * at - centre;
                    cuts.push(to.y.atan2(to.x));
                }
            }
        }
        cuts.sort_unstable_by(f64::total_cmp);
        cuts
    }
}
