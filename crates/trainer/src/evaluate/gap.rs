//! The gap of a tour to the best.

/// |f - f*| / |f*|; 0 where both are 0, 1 where only f* is.
pub fn gap(objective: f64, best: f64) -> f64 {
    const ZERO: f64 = 1e-9;
    match (objective.abs() < ZERO, best.abs() < ZERO) {
        (true, true) => 0.0,
        (false, true) => 1.0,
        _ => (objective - best).abs() / best.abs(),
    }
}
