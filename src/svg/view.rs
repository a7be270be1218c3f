//! From metres to the picture's units. Any finite coordinates are welcome: a single point, points on a
//! line, and numbers so large that their difference overflows.

/// The map's left edge.
pub(super) const LEFT: f64 = 72.0;
/// The map's upper edge.
pub(super) const TOP: f64 = 104.0;
/// The map's width.
pub(super) const WIDTH: f64 = 868.0;
const LOWEST: f64 = 520.0;
const HIGHEST: f64 = 868.0;
/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;
/// A quarter of a double's range still adds and subtracts.
const QUARTER: f64 = 0.25;

/// The map's place in the picture.
pub(super) struct View {
    /// The map's height.
    pub height: f64,
    /// Centre, in quarter metres.
    centre: [f64; 2],
    /// Picture units per quarter metre.
    scale: f64,
}

impl View {
    /// The view that shows every point.
    pub fn of(points: impl Iterator<Item = [f64; 2]>) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis] * QUARTER);
                high[axis] = high[axis].max(point[axis] * QUARTER);
            }
        }
        if low[0] > high[0] || low[1] > high[1] {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let centre = [0, 1].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        let extent = [0, 1].map(|axis| high[axis] - low[axis]);
        // A point has no extent: then some metres around it, or what its magnitude can tell apart.
        let least = (centre[0].abs().max(centre[1].abs()) * 1e-9).max(1.0);
        let longest = extent[0].max(extent[1]);
        let longest = if longest < least * 1e-3 { least * 10.0 } else { longest };
        let room = 1.0 + 2.0 * ROOM;
        let [wide, high] = extent.map(|e| e.max(longest * 0.02) * room);
        let height = (WIDTH * (high / wide)).clamp(LOWEST, HIGHEST);
        let scale = (WIDTH / wide).min(height / high);
        Self { height, centre, scale }
    }

    /// A place on the map.
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        [
            LEFT + WIDTH / 2.0 + (point[0] * QUARTER - self.centre[0]) * self.scale,
            TOP + self.height / 2.0 - (point[1] * QUARTER - self.centre[1]) * self.scale,
        ]
    }

    /// A length on the map; no renderer is asked for more than a hundred thousand units.
    pub fn length(&self, metres: f64) -> f64 {
        (metres * QUARTER * self.scale).min(1e5)
    }

    /// The map's lower edge.
    pub fn bottom(&self) -> f64 {
        TOP + self.height
    }

    /// The map's right edge.
    pub fn right(&self) -> f64 {
        LEFT + WIDTH
    }

    /// Positions and values of the grid's lines along an axis (0: across, 1: up).
    pub fn ticks(&self, axis: usize) -> Vec<(f64, String)> {
        let span = if axis == 0 { WIDTH } else { self.height };
        let metres = span / self.scale / QUARTER;
        let step = nice(WIDTH / self.scale / QUARTER / 7.0);
        let low = (self.centre[axis] - span / self.scale / 2.0) / QUARTER;
        let first = (low / step).ceil();
        if !(metres.is_finite() && low.is_finite() && first.is_finite() && step > 0.0) {
            return Vec::new();
        }
        let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
        let count = ((metres / step).floor() as usize + 1).min(24);
        let tick = |i: usize| {
            let value = (first + i as f64) * step;
            let place = self.at([value; 2])[axis];
            let inside = if axis == 0 { LEFT..=self.right() } else { TOP..=self.bottom() };
            inside.contains(&place).then(|| (place, super::text::number(value, decimals)))
        };
        (0..count).filter_map(tick).collect()
    }
}

/// The next larger of 1, 2 or 5 times a power of ten.
fn nice(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    match step / power {
        x if x <= 1.0 => power,
        x if x <= 2.0 => 2.0 * power,
        x if x <= 5.0 => 5.0 * power,
        _ => 10.0 * power,
    }
}

/// A coordinate rounded to a tenth, which keeps the document short.
pub(super) fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::{LEFT, TOP, View, WIDTH};

    fn inside(points: &[[f64; 2]]) {
        let view = View::of(points.iter().copied());
        for &point in points {
            let [x, y] = view.at(point);
            assert!((LEFT..=LEFT + WIDTH).contains(&x), "{point:?} is at {x}");
            assert!((TOP..=TOP + view.height).contains(&y), "{point:?} is at {y}");
        }
        assert!(view.ticks(0).len() <= 24 && view.ticks(1).len() <= 24);
    }

    #[test]
    fn every_point_is_inside() {
        inside(&[[0.0, 0.0], [500.0, 500.0], [100.0, 3.0]]);
        inside(&[[7.0, 7.0]]);
        inside(&[[1e15, 7.0], [1e15 + 1.0, 7.0]]);
        inside(&[[0.0, 0.0], [0.0, 1e6]]);
        inside(&[[-f64::MAX, -f64::MAX], [f64::MAX, f64::MAX]]);
        inside(&[[f64::MAX, 1.0]]);
        inside(&[[0.0, 0.0], [1e-300, 0.0]]);
        inside(&[]);
    }

    #[test]
    fn ticks_are_round() {
        let view = View::of([[0.0, 0.0], [500.0, 500.0]].into_iter());
        let labels: Vec<_> = view.ticks(0).into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0", "100", "200", "300", "400", "500"]);
    }
}
