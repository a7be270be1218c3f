//! Where two curves of the arrangement cross. A tangency is no vertex: the sets on both sides of a
//! curve are the same before and after it.

use nalgebra::{UnitVector2, Vector2};

use super::border::Edge;
use crate::scenario::Point;

/// A circle: its centre and its radius.
pub(super) type Circle = (Point, f64);

/// The crossings of two different circles: none or two.
pub(super) fn circle_circle(
    (centre, radius): Circle,
    (other, range): Circle,
) -> impl Iterator<Item = Point> {
    let between = other - centre;
    let distance = between.norm();
    // The factors of four areas (Heron) keep their digits near a tangency, and for circles that nearly
    // coincide, where differences of squares would lose them. The difference of the ranges comes first.
    let sum = radius + range;
    let difference = range - radius;
    let outer = sum - distance;
    let crosses = outer > 0.0 && distance > difference.abs();
    let axis = between / distance;
    let along = 0.5 * (distance - difference * (sum / distance));
    let product = outer * (sum + distance) * (distance + difference) * (distance - difference);
    let across = product.sqrt() / (2.0 * distance);
    on_both_sides(crosses, centre + axis * along, axis, across)
}

/// The crossings of a circle and a closed edge: none, one or two. A point that much beyond the
/// edge's ends still counts.
pub(super) fn circle_edge(
    (centre, radius): Circle,
    edge: &Edge,
    tolerance: f64,
) -> impl Iterator<Item = Point> {
    let direction = UnitVector2::new_normalize(edge.to - edge.from);
    let length = (edge.to - edge.from).norm();
    let offset = edge.offset(centre);
    let normal = Vector2::new(-direction.y, direction.x);
    let crosses = offset.abs() < radius;
    let reach = ((radius - offset.abs()) * (radius + offset.abs())).sqrt();
    let foot = centre - normal * offset;
    let from = edge.from;
    on_both_sides(crosses, foot, normal, reach).filter(move |point| {
        let along = (point - from).dot(&direction);
        along >= -tolerance && along <= length + tolerance
    })
}

/// The points at a distance to the left and right of an axis through `foot`.
fn on_both_sides(
    any: bool,
    foot: Point,
    axis: Vector2<f64>,
    distance: f64,
) -> impl Iterator<Item = Point> {
    let across = Vector2::new(-axis.y, axis.x) * distance;
    any.then_some([foot + across, foot - across]).into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_lie_on_both_circles() {
        for (x, range) in [(199.999_999, 100.0), (1e-6, 100.0), (1e-9, 100.0), (1.0, 100.999_999)] {
            let circles = [(Point::origin(), 100.0), (Point::new(0.6 * x, 0.8 * x), range)];
            let points: Vec<Point> = circle_circle(circles[0], circles[1]).collect();
            assert_eq!(points.len(), 2, "{x} {range}");
            for (centre, radius) in circles {
                for point in &points {
                    let offset = (point - centre).norm() - radius;
                    assert!(offset.abs() < 1e-12, "{x} {range}: {offset:e}");
                }
            }
        }
    }
}
