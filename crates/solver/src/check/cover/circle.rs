//! The walk around one circle: the ground inside it and the ground outside it.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use super::disks::Disk;
use super::faces::Faces;
use super::sweep::{OUTSIDE, Stretch, pieces};

/// An arc of a circle that something covers: centre and half-width, in radians.
#[derive(Clone, Copy, Debug)]
struct Arc {
    middle: f64,
    half: f64,
    who: u32,
}

/// Notes the faces on both sides of disk `i`'s circle.
pub(super) fn sweep(faces: &mut Faces<'_>, i: u32) {
    let disk = faces.disks.get(i);
    let (low, high) = disk.bounds();
    let mut arcs = outside_field(faces, disk);
    // Disks of the same circle lie inside it together, and one walk serves them all.
    let mut twins = vec![i];
    for j in faces.disks.near(low, high).filter(|j| *j != i) {
        let other = faces.disks.get(j);
        if other == disk {
            twins.push(j);
        } else {
            arcs.extend(covered(disk, other, j));
        }
    }
    if twins.iter().any(|j| *j < i) {
        return;
    }
    // The walk begins where an arc begins, so that no piece is cut by the seam.
    let seam = arcs.iter().find(|arc| arc.half < PI).map_or(0.0, |arc| arc.middle - arc.half);
    let stretches: Vec<_> =
        arcs.iter().flat_map(|arc| unroll(*arc, seam)).map(|s| scale(s, disk.radius)).collect();
    pieces(TAU * disk.radius, &stretches, |from, to, covering| {
        let on = |share: f64| {
            let angle = seam + (from + share * (to - from)) / disk.radius;
            Vector2::new(angle.cos(), angle.sin())
        };
        let inside = covering.iter().chain(&twins).copied();
        faces.note(inside, to - from, |share, step| disk.centre + on(share) * (disk.radius - step));
        let outside = covering.iter().copied();
        faces
            .note(outside, to - from, |share, step| disk.centre + on(share) * (disk.radius + step));
    });
}

/// The arcs of a circle that lie outside the field.
fn outside_field(faces: &Faces<'_>, disk: Disk) -> Vec<Arc> {
    let inside = |angle: f64| {
        let ray = Vector2::new(angle.cos(), angle.sin());
        faces.field.contains(disk.centre + ray * disk.radius)
    };
    let cuts = faces.field.cuts(disk);
    let Some(first) = cuts.first() else {
        let all = Arc { middle: 0.0, half: PI, who: OUTSIDE };
        return if inside(0.0) { Vec::new() } else { vec![all] };
    };
    let ends = cuts.iter().skip(1).copied().chain([first + TAU]);
    let between = cuts.iter().zip(ends).map(|(from, to)| Arc {
        middle: 0.5 * (from + to),
        half: 0.5 * (to - from),
        who: OUTSIDE,
    });
    between.filter(|arc| !inside(arc.middle)).collect()
}

/// The arc of a circle that another disk covers.
fn covered(disk: Disk, other: Disk, who: u32) -> Option<Arc> {
    let to = other.centre - disk.centre;
    let apart = to.norm();
    // The law of cosines for half the angle, in factors that keep their digits near a tangency.
    let near = (other.radius - disk.radius + apart) * (other.radius + disk.radius - apart);
    let far = (disk.radius + apart - other.radius) * (disk.radius + apart + other.radius);
    if far <= 0.0 {
        return Some(Arc { middle: 0.0, half: PI, who });
    }
    let half = 2.0 * near.max(0.0).sqrt().atan2(far.sqrt());
    (near > 0.0).then_some(Arc { middle: to.y.atan2(to.x), half, who })
}

/// An arc as angles from the seam, in two where it passes over the seam.
fn unroll(arc: Arc, seam: f64) -> impl Iterator<Item = Stretch> {
    let Arc { middle, half, who } = arc;
    let whole = half >= PI;
    let from = if whole { 0.0 } else { (middle - half - seam).rem_euclid(TAU) };
    let to = if whole { TAU } else { from + 2.0 * half };
    let before = Stretch { from, to: to.min(TAU), who };
    let after = Stretch { from: 0.0, to: to - TAU, who };
    std::iter::once(before).chain((to > TAU).then_some(after))
}

fn scale(stretch: Stretch, radius: f64) -> Stretch {
    Stretch { from: stretch.from * radius, to: stretch.to * radius, who: stretch.who }
}
