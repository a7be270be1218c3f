//! The words that stand for states and outcomes in the database.

use voltour_solver::plan::Status;

use crate::domain::{DepartureState, Outcome, RequestState, Role, TourState};

/// A value that the database holds as a word.
pub(super) trait Word: Sized + Copy + 'static {
    const ALL: &'static [(Self, &'static str)];

    fn from_word(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, name)| *name == word).map(|(value, _)| *value)
    }

    fn word(self) -> &'static str
    where
        Self: PartialEq,
    {
        // Every value is in the list.
        Self::ALL.iter().find(|(value, _)| *value == self).map_or("", |(_, name)| name)
    }
}

macro_rules! words {
    ($type:ident: $($value:ident = $word:literal),+ $(,)?) => {
        impl Word for $type {
            const ALL: &'static [(Self, &'static str)] = &[$(($type::$value, $word)),+];
        }
    };
}

words!(RequestState: Open = "open", Batched = "batched", Planned = "planned", Served = "served",
    Expired = "expired", Withdrawn = "withdrawn", Superseded = "superseded");
words!(DepartureState: Announced = "announced", Closed = "closed", Planned = "planned",
    Completed = "completed", Overdue = "overdue", Cancelled = "cancelled", Missed = "missed");
words!(TourState: Out = "out", Completed = "completed", Overdue = "overdue",
    Cancelled = "cancelled");
words!(Role: BaseStation = "base_station", Charger = "charger", Operator = "operator",
    Admin = "admin");
words!(Outcome: Charged = "charged", Skipped = "skipped", Failed = "failed");
words!(Status: Optimal = "optimal", Feasible = "feasible", BestEffort = "best_effort",
    Infeasible = "infeasible");
