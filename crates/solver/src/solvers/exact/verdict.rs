//! Whether any tour keeps every constraint.

use crate::instance::Instance;
use crate::solvers::Budget;
use crate::solvers::enumerate;
use crate::tour::{Tour, Value};

/// What is known of an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// This tour, as candidates in order, keeps every constraint.
    Feasible(Vec<u32>),
    /// Proven: no tour that the check accepts keeps every constraint.
    Infeasible,
    /// The budget ended before either was shown.
    Unknown,
}

/// Decides whether any tour keeps every constraint.
pub fn decide(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Verdict {
    if instance.len() > enumerate::MOST {
        return Verdict::Unknown;
    }
    match enumerate::enumerate(instance, budget) {
        Some(order) if Value::of(instance, &Tour::new(instance, &order)).is_feasible() => {
            Verdict::Feasible(order)
        }
        _ if budget.is_spent() => Verdict::Unknown,
        _ => Verdict::Infeasible,
    }
}
