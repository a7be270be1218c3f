//! A simple polygon, proven simple when it is made: exact orientation tests, and an index over the
//! edges so that fields of many corners stay cheap.

use robust::{Coord, orient2d};
use rstar::{RTree, primitives::GeomWithData, primitives::Rectangle};

use super::model::Point;

/// A simple polygon, corners in counter-clockwise order.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Point>,
}

impl Polygon {
    /// A polygon from its corners in either orientation, not closed by repeating the first.
    ///
    /// # Errors
    /// The rule that the corners break.
    pub fn new(mut corners: Vec<Point>) -> Result<Self, &'static str> {
        if corners.len() < 3 {
            return Err("needs at least three corners");
        }
        let edges = edges_of(&corners);
        if edges.iter().any(|[a, b]| a == b) {
            return Err("a corner is repeated");
        }
        if any_edges_touch(&edges) {
            return Err("edges cross or touch: the polygon must be simple");
        }
        let area = signed_area(&corners);
        if area == 0.0 || !area.is_finite() {
            return Err("area must be greater than 0");
        }
        if area < 0.0 {
            corners.reverse();
        }
        Ok(Self { corners })
    }

    /// At least three, counter-clockwise.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// The edges, each from a corner to the next one counter-clockwise.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = [Point; 2]> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| [self.corners[i], self.corners[(i + 1) % n]])
    }

    /// Area in square metres, > 0.
    pub fn area_m2(&self) -> f64 {
        signed_area(&self.corners)
    }

    /// Whether a point lies inside (even-odd rule); a point on the border may fall on either side.
    pub fn contains(&self, point: Point) -> bool {
        let crossed = |[a, b]: [Point; 2]| {
            (a.y > point.y) != (b.y > point.y) && (orient(a, b, point) > 0.0) == (b.y > a.y)
        };
        self.edges().filter(|edge| crossed(*edge)).count() % 2 == 1
    }
}

fn edges_of(corners: &[Point]) -> Vec<[Point; 2]> {
    let n = corners.len();
    (0..n).map(|i| [corners[i], corners[(i + 1) % n]]).collect()
}

fn signed_area(corners: &[Point]) -> f64 {
    // Relative to the first corner, so that fields far from the origin keep their digits.
    let origin = corners[0];
    let cross = |[a, b]: [Point; 2]| (a - origin).perp(&(b - origin));
    edges_of(corners).into_iter().map(cross).sum::<f64>() / 2.0
}

fn any_edges_touch(edges: &[[Point; 2]]) -> bool {
    let boxed = |(i, [a, b]): (usize, &[Point; 2])| {
        GeomWithData::new(Rectangle::from_corners([a.x, a.y], [b.x, b.y]), i)
    };
    let tree = RTree::bulk_load(edges.iter().enumerate().map(boxed).collect());
    let n = edges.len();
    let conflict = |i: usize, j: usize| {
        if j == (i + 1) % n {
            neighbours_overlap(edges[i], edges[j])
        } else if i == (j + 1) % n {
            neighbours_overlap(edges[j], edges[i])
        } else {
            touch(edges[i], edges[j])
        }
    };
    (0..n).any(|i| {
        let [a, b] = edges[i];
        let low = [a.x.min(b.x), a.y.min(b.y)];
        let high = [a.x.max(b.x), a.y.max(b.y)];
        let near = rstar::AABB::from_corners(low, high);
        tree.locate_in_envelope_intersecting(near)
            .any(|other| other.data != i && conflict(i, other.data))
    })
}

/// Two edges that share a corner (`first` ends where `second` begins) overlap if they turn back.
fn neighbours_overlap(first: [Point; 2], second: [Point; 2]) -> bool {
    let turns_back = (first[1] - first[0]).dot(&(second[1] - second[0])) < 0.0;
    orient(first[0], first[1], second[1]) == 0.0 && turns_back
}

/// Whether two closed segments have a point in common.
fn touch([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let (abc, abd) = (orient(a, b, c), orient(a, b, d));
    let (cda, cdb) = (orient(c, d, a), orient(c, d, b));
    let apart = |x: f64, y: f64| (x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0);
    if abc == 0.0 && abd == 0.0 {
        return boxes_meet([a, b], [c, d]);
    }
    !apart(abc, abd) && !apart(cda, cdb)
}

fn boxes_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let meet = |a: f64, b: f64, c: f64, d: f64| a.min(b) <= c.max(d) && c.min(d) <= a.max(b);
    meet(a.x, b.x, c.x, d.x) && meet(a.y, b.y, c.y, d.y)
}

/// Positive where a, b, c turn left; exact in its sign.
fn orient(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}
