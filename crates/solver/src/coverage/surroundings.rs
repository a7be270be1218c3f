//! All curves that matter near a disk or a corner, laid out for fast evaluation at many points.
//! A disk that covers a point of disk i meets disk i, so the neighbours of i are all there is to ask.

use super::border::Edge;
use super::disks::Curves;
use crate::scenario::Point;

/// Largest relative error of a distance between two given points, with a reserve of two.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Relative to the coordinates, how far a computed vertex may lie from the curves through it.
const DRIFT: f64 = 1e-14;
/// Metres: the least distance within which a curve counts as passing through a vertex. Two decades
/// below the 1e-9 m of the format, so that no face that counts is merged away.
const LEAST_TOLERANCE: f64 = 1e-11;
/// How far the surroundings of a disk reach past it, relative to its range.
const REACH: f64 = 0.04;

/// The curves that may lie within `reach` of a part of the plane.
pub(super) struct Surroundings {
    /// The disks, rising; the next three run parallel.
    pub(super) disks: Vec<u32>,
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) range: Vec<f64>,
    pub(super) edges: Vec<Edge>,
    /// Beyond it there may be other curves.
    pub(super) reach: f64,
    /// Within it a curve counts as passing through a vertex.
    pub(super) tolerance: f64,
    /// Rounding of the distance to an edge, here and for whoever computes it in world coordinates.
    margin: f64,
    /// Where no edge is near: whether this part lies inside the field.
    inside: bool,
}

impl Surroundings {
    pub(super) fn of_disk(curves: &Curves, disk: u32) -> Self {
        let disk = curves.disks.get(disk);
        Self::new(curves, disk.centre, disk.range, REACH * disk.range)
    }

    pub(super) fn of_point(curves: &Curves, point: Point) -> Self {
        Self::new(curves, point, 0.0, 0.01 * curves.border.extent())
    }

    fn new(curves: &Curves, centre: Point, range: f64, reach: f64) -> Self {
        let Curves { frame, border, disks } = curves;
        let near = disks.near(centre, range + reach);
        let take = |part: fn(Point, f64) -> f64| -> Vec<f64> {
            let disks = near.iter().map(|&i| disks.get(i));
            disks.map(|disk| part(disk.centre, disk.range)).collect()
        };
        let edges = border.edges_near(centre, range + reach);
        let inside = edges.is_empty() && border.contains(centre);
        Self {
            x: take(|centre, _| centre.x),
            y: take(|centre, _| centre.y),
            range: take(|_, range| range),
            disks: near,
            edges,
            reach,
            tolerance: LEAST_TOLERANCE.max(DRIFT * (border.scale() + range)),
            margin: ROUNDING * border.extent().max(0.25 * frame.distance()),
            inside,
        }
    }

    /// Writes, disk by disk, how far outside its circle a point lies (negative: inside).
    pub(super) fn offsets(&self, point: Point, offsets: &mut Vec<f64>) {
        let disks = self.x.iter().zip(&self.y).zip(&self.range);
        offsets.clear();
        offsets.extend(disks.map(|((x, y), range)| {
            let (dx, dy) = (point.x - x, point.y - y);
            (dx * dx + dy * dy).sqrt() - range
        }));
    }

    /// Writes the disks that cover a point with these offsets.
    pub(super) fn covering(&self, offsets: &[f64], set: &mut Vec<u32>) {
        // Every disk is written, the ones outside to be overwritten: a branch that nobody can
        // predict would cost more.
        set.resize(self.disks.len() + 1, 0);
        let mut len = 0;
        for (&offset, &disk) in offsets.iter().zip(&self.disks) {
            set[len] = disk;
            len += usize::from(offset <= 0.0);
        }
        set.truncate(len);
    }

    /// Within it, the offset of a vertex from the `i`-th disk cannot be told from zero.
    pub(super) fn tolerance_of(&self, i: usize) -> f64 {
        self.tolerance.max(DRIFT * self.range[i])
    }

    /// Whether a point that is not on the border lies inside the field.
    pub(super) fn in_field(&self, curves: &Curves, point: Point) -> bool {
        if self.edges.is_empty() { self.inside } else { curves.border.contains(point) }
    }

    /// Writes the disks that cover a point into `set`, and returns its distance from the nearest
    /// curve (at most `reach`). `None` outside the field, and where rounding leaves a doubt.
    pub(super) fn locate(
        &self,
        curves: &Curves,
        point: Point,
        offsets: &mut Vec<f64>,
        set: &mut Vec<u32>,
    ) -> Option<f64> {
        self.offsets(point, offsets);
        let mut depth = self.reach;
        for (&offset, &range) in offsets.iter().zip(&self.range) {
            if offset.abs() <= ROUNDING * range {
                return None;
            }
            depth = depth.min(offset.abs());
        }
        self.covering(offsets, set);
        for edge in &self.edges {
            depth = depth.min(edge.distance(point));
        }
        let clear = depth > 0.0 && (self.edges.is_empty() || depth > self.margin);
        (clear && self.in_field(curves, point)).then_some(depth)
    }
}
