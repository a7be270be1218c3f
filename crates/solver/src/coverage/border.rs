//! The border of the field in local coordinates, indexed so that fields of many corners stay cheap.

use robust::{Coord, orient2d};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::frame::Frame;
use crate::scenario::{Point, Polygon};

/// Up to so many edges, looking at all of them is faster than asking the index.
const FEW_EDGES: usize = 24;

/// An edge of the field.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Edge {
    /// The distance from a point to the closed segment.
    pub(super) fn distance(&self, point: Point) -> f64 {
        let along = self.to - self.from;
        let share = (point - self.from).dot(&along) / along.norm_squared();
        if share <= 0.0 {
            (point - self.from).norm()
        } else if share >= 1.0 {
            (point - self.to).norm()
        } else {
            self.offset(point).abs()
        }
    }

    /// The signed distance from the edge's line, positive on its left (inside the field).
    pub(super) fn offset(&self, point: Point) -> f64 {
        let along = self.to - self.from;
        along.perp(&(point - self.from)) / along.norm()
    }

    /// Whether a ray to the right of the point crosses the edge (half-open, so that a ray through a
    /// corner counts once).
    fn is_right_of(&self, point: Point) -> bool {
        let Self { from, to } = self;
        let straddles = (from.y > point.y) != (to.y > point.y);
        straddles && (orient(*from, *to, point) > 0.0) == (to.y > from.y)
    }
}

/// The field's border.
pub(super) struct Border {
    edges: Vec<Edge>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
    pub(super) low: Point,
    pub(super) high: Point,
}

impl Border {
    pub(super) fn new(field: &Polygon, frame: &Frame) -> Self {
        let edge = |[a, b]: [Point; 2]| Edge { from: frame.local(a), to: frame.local(b) };
        let edges: Vec<Edge> = field.edges().map(edge).collect();
        let boxed = |(i, Edge { from, to }): (u32, &Edge)| {
            GeomWithData::new(Rectangle::from_corners([from.x, from.y], [to.x, to.y]), i)
        };
        let index = RTree::bulk_load((0..).zip(&edges).map(boxed).collect());
        let corners = || edges.iter().map(|edge| edge.from);
        let low = corners().fold(edges[0].from, |low, p| low.inf(&p));
        let high = corners().fold(edges[0].from, |high, p| high.sup(&p));
        Self { edges, index, low, high }
    }

    /// The corners, counter-clockwise.
    pub(super) fn corners(&self) -> impl Iterator<Item = Point> + '_ {
        self.edges.iter().map(|edge| edge.from)
    }

    /// The longer side of the bounding box.
    pub(super) fn extent(&self) -> f64 {
        (self.high - self.low).max()
    }

    /// The largest coordinate of a point of the field.
    pub(super) fn scale(&self) -> f64 {
        self.low.coords.amax().max(self.high.coords.amax())
    }

    /// Whether a point lies in the bounding box, grown by a margin.
    pub(super) fn boxes(&self, point: Point, margin: f64) -> bool {
        let beyond =
            |axis: usize| (self.low[axis] - point[axis]).max(point[axis] - self.high[axis]);
        beyond(0).max(beyond(1)) <= margin
    }

    /// Whether a point that is not on the border lies inside; exact in its sign.
    pub(super) fn contains(&self, point: Point) -> bool {
        let crossings = if self.edges.len() <= FEW_EDGES {
            self.edges.iter().filter(|edge| edge.is_right_of(point)).count()
        } else {
            let ray = AABB::from_corners([point.x, point.y], [self.high.x.max(point.x), point.y]);
            let hit = self.index.locate_in_envelope_intersecting(ray);
            hit.filter(|hit| self.edges[hit.data as usize].is_right_of(point)).count()
        };
        crossings % 2 == 1
    }

    /// The edges within a distance of a point, in a fixed order.
    pub(super) fn edges_near(&self, point: Point, distance: f64) -> Vec<Edge> {
        let low = [point.x - distance, point.y - distance];
        let high = [point.x + distance, point.y + distance];
        let near = self.index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
        let close = |&i: &u32| self.edges[i as usize].distance(point) <= distance;
        let mut near: Vec<u32> = near.map(|hit| hit.data).filter(close).collect();
        near.sort_unstable();
        near.into_iter().map(|i| self.edges[i as usize]).collect()
    }
}

fn orient(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}
