//! The gap: how far a tour may be from the best one, as far as is proven. It follows from the plan, so
//! that the document has no field for it.

use crate::plan::{Plan, Status};
use crate::tolerance::{agrees, tolerance};

/// `|f - f*| / |f*|` of an objective `f` with the proven bound `f*`: 0 where they agree within the
/// tolerance, 1 where only the bound is 0. None without a bound; and none where the tour is not
/// feasible, for its objective is then no rival of the bound.
pub fn gap(status: Status, objective: f64, bound: Option<f64>) -> Option<f64> {
    let bound = bound.filter(|_| status.is_feasible())?;
    Some(to_best(objective, bound)).filter(|gap| gap.is_finite())
}

/// `|f - f*| / |f*|` of an objective `f` with the best one, `f*`: 0 where they agree within the tolerance, 1
/// where only the best is 0.
pub fn to_best(objective: f64, best: f64) -> f64 {
    match () {
        () if agrees(objective, best) => 0.0,
        () if best.abs() <= tolerance(0.0) => 1.0,
        () => (objective - best).abs() / best.abs(),
    }
}

/// A gap as it is read, such as `0.42 %`.
pub fn percent(gap: f64) -> String {
    let percent = 100.0 * gap;
    match percent {
        0.0 => "0 %".to_owned(),
        _ if percent < 0.01 => "under 0.01 %".to_owned(),
        _ if percent < 1e6 => format!("{percent:.2} %"),
        _ => "over 1000000 %".to_owned(),
    }
}

impl Plan {
    /// The [gap] of the plan's objective to its bound.
    pub fn gap(&self) -> Option<f64> {
        gap(self.status, self.objective, self.bound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Status::{BestEffort, Feasible, Infeasible, Optimal};

    #[test]
    fn it_is_relative_to_the_bound_whichever_side_that_is_on() {
        assert_eq!(gap(Feasible, 110.0, Some(100.0)), Some(0.1));
        assert_eq!(gap(Feasible, 3.0, Some(4.0)), Some(0.25));
        assert_eq!(gap(Feasible, 110.0, None), None);
    }

    #[test]
    fn zeros_are_as_the_measures_say() {
        assert_eq!(gap(Optimal, 0.0, Some(0.0)), Some(0.0));
        assert_eq!(gap(Feasible, 7.0, Some(0.0)), Some(1.0));
        assert_eq!(gap(Feasible, 0.0, Some(4.0)), Some(1.0));
    }

    #[test]
    fn what_agrees_within_the_tolerance_has_none() {
        assert_eq!(gap(Optimal, 282.8427124, Some(282.8427121)), Some(0.0));
        assert_eq!(gap(Optimal, 1e-9, Some(0.0)), Some(0.0));
    }

    #[test]
    fn a_tour_that_is_not_feasible_has_none() {
        assert_eq!(gap(BestEffort, 90.0, Some(100.0)), None);
        assert_eq!(gap(Infeasible, 90.0, None), None);
        assert_eq!(gap(Feasible, f64::INFINITY, Some(1.0)), None);
    }

    #[test]
    fn it_is_read_in_percent() {
        let read = [0.0, 1e-6, 0.004_21, 1.0, 1e9].map(percent);
        assert_eq!(read, ["0 %", "under 0.01 %", "0.42 %", "100.00 %", "over 1000000 %"]);
    }
}
