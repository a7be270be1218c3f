//! The checker's own reading of the format's tolerance.

/// How far a number may lie from `x` and still agree with it.
pub(super) fn slack(x: f64) -> f64 {
    1e-6_f64.max(1e-6 * x.abs())
}

/// Whether a claim agrees with what was recomputed. False for NaN.
pub(super) fn equal(claimed: f64, expected: f64) -> bool {
    (claimed - expected).abs() <= slack(expected)
}

/// Whether `value <= limit` is kept. False for NaN.
pub(super) fn keeps(value: f64, limit: f64) -> bool {
    value <= limit + slack(limit)
}

/// How surely a limit is kept. Who plans and who checks round differently, so a claim that hangs
/// on a value near the point where the comparison flips may be made either way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Verdict {
    Kept,
    Either,
    Broken,
}

/// Judges `value <= limit`.
pub(super) fn judge(value: f64, limit: f64) -> Verdict {
    if value <= limit {
        Verdict::Kept
    } else if value <= limit + 2.0 * slack(limit) {
        Verdict::Either
    } else {
        Verdict::Broken
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerance_is_absolute_below_one_and_relative_above() {
        assert!(equal(0.9e-6, 0.0) && !equal(1.1e-6, 0.0));
        assert!(equal(1e6 + 0.9, 1e6) && !equal(1e6 + 1.1, 1e6));
        assert!(keeps(1e6 + 0.9, 1e6) && !keeps(1e6 + 1.1, 1e6) && keeps(-5.0, 0.0));
        assert!(!equal(f64::NAN, 0.0) && !equal(0.0, f64::NAN) && !keeps(f64::NAN, 0.0));
    }

    #[test]
    fn verdict_is_open_only_beside_the_flip() {
        assert_eq!(judge(10.0, 10.0), Verdict::Kept);
        assert_eq!(judge(10.0 + 1.5e-5, 10.0), Verdict::Either);
        assert_eq!(judge(10.0 + 2.5e-5, 10.0), Verdict::Broken);
        assert_eq!(judge(f64::NAN, 10.0), Verdict::Broken);
    }
}
