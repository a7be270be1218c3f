//! The walk along one edge of the field's border: the ground on its inner side.

use nalgebra::Vector2;

use crate::scenario::Point;

use super::disks::Disk;
use super::faces::Faces;
use super::sweep::{Stretch, pieces};

/// Notes the faces on the inner side of the edge from `a` to `b`.
pub(super) fn sweep(faces: &mut Faces<'_>, a: Point, b: Point) {
    let length = (b - a).norm();
    let along = (b - a) / length;
    let inward = Vector2::new(-along.y, along.x);
    let low = [a.x.min(b.x), a.y.min(b.y)];
    let high = [a.x.max(b.x), a.y.max(b.y)];
    let near = faces.disks.near(low, high);
    let stretch = |who| covered(a, along, length, faces.disks.get(who), who);
    let stretches: Vec<_> = near.filter_map(stretch).collect();
    pieces(length, &stretches, |from, to, covering| {
        let on = |share: f64| a + along * (from + share * (to - from));
        faces.note(covering.iter().copied(), to - from, |share, step| on(share) + inward * step);
    });
}

/// The stretch of an edge that a disk covers.
fn covered(a: Point, along: Vector2<f64>, length: f64, disk: Disk, who: u32) -> Option<Stretch> {
    let foot = along.dot(&(disk.centre - a));
    let height = along.perp(&(disk.centre - a)).abs();
    let half = ((disk.radius - height) * (disk.radius + height)).max(0.0).sqrt();
    let (from, to) = ((foot - half).max(0.0), (foot + half).min(length));
    (from < to).then_some(Stretch { from, to, who })
}
