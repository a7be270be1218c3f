//! The tolerance of the format: a comparison x <= limit holds up to max(1e-6, 1e-6 |limit|).

/// How far a value may exceed `limit` and still keep it.
pub fn tolerance(limit: f64) -> f64 {
    1e-6_f64.max(1e-6 * limit.abs())
}

/// Whether `value <= limit`, as `check` judges it.
pub fn holds(value: f64, limit: f64) -> bool {
    value <= limit + tolerance(limit)
}

/// The largest value that a solver allows itself under `limit`: half the tolerance, so that the
/// independent recomputation, which rounds otherwise, still accepts the tour.
pub fn solver_limit(limit: f64) -> f64 {
    limit + 0.5 * tolerance(limit)
}

/// Whether two numbers agree within the tolerance.
pub fn agrees(value: f64, expected: f64) -> bool {
    (value - expected).abs() <= tolerance(expected)
}
