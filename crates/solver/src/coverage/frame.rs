//! Local coordinates: a field far from the origin is moved near it, coordinate by coordinate and only
//! where the differences are exact, so that crossings keep the digits that the input has.

use crate::scenario::{Point, Polygon};

/// A translation of the plane.
pub(super) struct Frame {
    origin: [f64; 2],
}

impl Frame {
    pub(super) fn of(field: &Polygon) -> Self {
        let origin = [0, 1].map(|axis| {
            let along = || field.corners().iter().map(|corner| corner[axis]);
            let low = along().fold(f64::INFINITY, f64::min);
            let high = along().fold(f64::NEG_INFINITY, f64::max);
            // Numbers of one sign within a factor of two of each other have exact differences
            // (Sterbenz); nearer to the origin, moving could only lose digits.
            if low.abs().min(high.abs()) > 2.0 * (high - low) { low } else { 0.0 }
        });
        Self { origin }
    }

    /// The larger of the coordinates of the origin.
    pub(super) fn distance(&self) -> f64 {
        self.origin[0].abs().max(self.origin[1].abs())
    }

    pub(super) fn local(&self, world: Point) -> Point {
        Point::new(world.x - self.origin[0], world.y - self.origin[1])
    }

    pub(super) fn world(&self, local: Point) -> Point {
        Point::new(local.x + self.origin[0], local.y + self.origin[1])
    }

    /// The nearest local point that a world point in doubles can stand for.
    pub(super) fn representable(&self, local: Point) -> Point {
        self.local(self.world(local))
    }
}
