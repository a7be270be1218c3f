//! Where two curves of the arrangement meet. Curves that pass each other within the tolerance meet in
//! one point: a tangency is a vertex too, because faces may have no other.

use nalgebra::{UnitVector2, Vector2};

use super::border::Edge;
use crate::scenario::Point;

/// A circle: its centre and its radius.
pub(super) type Circle = (Point, f64);

/// The common points of two circles with different centres or radii: none, one or two.
pub(super) fn circle_circle(
    (centre, radius): Circle,
    (other, range): Circle,
    tolerance: f64,
) -> impl Iterator<Item = Point> {
    let between = other - centre;
    let distance = between.norm();
    // The factors of four areas (Heron) keep their digits near a tangency, and for circles that nearly
    // coincide, where differences of squares would lose them. The difference of the ranges comes first.
    let sum = radius + range;
    let difference = range - radius;
    let outer = sum - distance;
    let meets = distance > 0.0 && outer >= -tolerance && distance - difference.abs() >= -tolerance;
    let axis = if meets { between / distance } else { Vector2::zeros() };
    let along = 0.5 * (distance - difference * (sum / distance));
    let product = outer * (sum + distance) * (distance + difference) * (distance - difference);
    let across = product.max(0.0).sqrt() / (2.0 * distance);
    on_both_sides(meets, centre + axis * along.clamp(-radius, radius), axis, across)
}

/// The common points of a circle and a closed edge: none, one or two.
pub(super) fn circle_edge(
    (centre, radius): Circle,
    edge: &Edge,
    tolerance: f64,
) -> impl Iterator<Item = Point> {
    let direction = UnitVector2::new_normalize(edge.to - edge.from);
    let length = (edge.to - edge.from).norm();
    let offset = edge.offset(centre);
    let normal = Vector2::new(-direction.y, direction.x);
    let meets = offset.abs() <= radius + tolerance;
    let reach = ((radius - offset.abs()).max(0.0) * (radius + offset.abs())).sqrt();
    let foot = centre - normal * offset;
    let from = edge.from;
    on_both_sides(meets, foot, normal, reach).filter(move |point| {
        let along = (point - from).dot(&direction);
        along >= -tolerance && along <= length + tolerance
    })
}

/// The points at a distance to the left and right of an axis through `foot`; one if they coincide.
fn on_both_sides(
    any: bool,
    foot: Point,
    axis: Vector2<f64>,
    distance: f64,
) -> impl Iterator<Item = Point> {
    let across = Vector2::new(-axis.y, axis.x) * distance;
    let second = any && distance > 0.0;
    [any.then_some(foot + across), second.then_some(foot - across)].into_iter().flatten()
}
