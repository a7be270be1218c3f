//! The distinct covering sets that a caller asks for, each with a witness if the set is certain.

use std::collections::BTreeMap;

use crate::scenario::{Coverage, Point, Scenario};

use super::disks::{Disk, Disks};
use super::field::Field;
use super::{border, circle};

/// Covering sets as rising indices of sensors. A set is sure where a point of doubles shows it,
/// clear of every circle and of the border; a set without such a witness may be an artefact of
/// rounding (three circles through one point, two that just touch), or too thin to point into.
pub(super) type Sets = BTreeMap<Vec<u32>, Option<Point>>;

/// The walk over all circles and the border.
pub(super) struct Faces<'a> {
    pub(super) disks: &'a Disks,
    pub(super) field: &'a Field<'a>,
    wanted: &'a dyn Fn(&[u32]) -> bool,
    sets: Sets,
    buffer: Vec<u32>,
}

/// Every covering set of a sub-region inside the field that `wanted` asks for. It is asked with
/// the sensors in any order.
pub(super) fn sets(disks: &Disks, field: &Field<'_>, wanted: &dyn Fn(&[u32]) -> bool) -> Sets {
    let mut faces = Faces { disks, field, wanted, sets: Sets::new(), buffer: Vec::new() };
    for i in disks.indices() {
        circle::sweep(&mut faces, i);
    }
    for (a, b) in field.edges() {
        border::sweep(&mut faces, a, b);
    }
    faces.sets
}

impl Faces<'_> {
    /// Notes the set that covers the ground beside a piece of border; `probe` leads from a
    /// share of the piece that many metres into the face.
    pub(super) fn note(
        &mut self,
        covering: impl Iterator<Item = u32>,
        length: f64,
        probe: impl Fn(f64, f64) -> Point,
    ) {
        self.buffer.clear();
        self.buffer.extend(covering);
        if !(self.wanted)(&self.buffer) {
            return;
        }
        self.buffer.sort_unstable();
        if self.sets.get(&self.buffer).is_some_and(Option::is_some) {
            return;
        }
        let witness = self.witness(length, probe);
        self.sets.insert(self.buffer.clone(), witness);
    }

    /// A point that shows the set in the buffer, sought ever nearer to the border.
    fn witness(&self, length: f64, probe: impl Fn(f64, f64) -> Point) -> Option<Point> {
        // Lengths are rounded too: a piece just long enough proves nothing.
        const SURELY_LONG_M: f64 = 2e-9;
        const NEAREST: f64 = 1e-13;
        // More places than one, lest something touches the piece just there.
        const SHARES: [f64; 3] = [0.5, 0.31, 0.83];
        if length < SURELY_LONG_M {
            return None;
        }
        let steps = std::iter::successors(Some(0.5 * length), |step| Some(0.25 * step));
        let steps = steps.take_while(|step| *step > NEAREST * length);
        let mut points = steps.flat_map(|step| SHARES.map(|share| probe(share, step)));
        points.find(|point| {
            let cover = self.disks.at(*point, rounding(*point));
            cover.perhaps.is_empty()
                && cover.surely == self.buffer
                && self.field.contains(*point)
                && !self.field.border_within(*point, 1e-12 * (1.0 + point.coords.amax()))
        })
    }
}

/// How near a circle must pass to a point before rounding decides on which side it lies; generous,
/// so that nobody is held to sub-regions of a few units in the last place.
pub(super) fn rounding(point: Point) -> impl Fn(Disk) -> f64 {
    move |disk| 1e-12 * (disk.radius + disk.centre.coords.amax() + point.coords.amax())
}

/// The disks and the field of a scenario's coverage constraint.
pub(super) fn survey<'a>(scenario: &'a Scenario, coverage: &'a Coverage) -> (Disks, Field<'a>) {
    (Disks::of(scenario), Field::new(&coverage.field))
}
