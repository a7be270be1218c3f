//! [`Explanation`]: the document, field for field. Units are in the names: metres, seconds, joules.

use serde::{Deserialize, Serialize};

use super::change::NextChange;
use crate::plan::{Reason, Status};
use crate::scenario::Objective;

/// The only value of the field `format`.
pub const FORMAT: &str = "voltour/explanation/1";

/// Why a plan is as it is. [`Display`](std::fmt::Display) is the operator's text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Explanation {
    /// Always [`FORMAT`].
    pub format: String,
    /// The scenario's name.
    pub scenario: Option<String>,
    /// The plan's; `infeasible` also where only the explanation has proven it.
    pub status: Status,
    /// What the tour optimises.
    pub objective: Objective,
    /// Constraints that contradict each other; there only where that is proven.
    pub conflict: Option<Conflict>,
    /// A tour that keeps every constraint, as sensors in order, where the plan's does not and one was found.
    pub feasible_tour: Option<Vec<String>>,
    /// Every request that is not a stop, in document order.
    pub unserved: Vec<WhyUnserved>,
    /// Every stop, in the order of the tour.
    pub served: Vec<WhyServed>,
    /// What the next change would buy, the best first of each kind.
    pub next: Vec<NextChange>,
    /// Whether the stop rule left every question its answer.
    pub complete: bool,
    /// Iterations that it took.
    pub iterations: u64,
}

/// Constraints that no tour keeps together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conflict {
    /// Alone, with everything else of the scenario dropped, these are infeasible.
    pub clauses: Vec<Clause>,
    /// Proven: take any one of them away, and a tour keeps the others.
    pub irreducible: bool,
    /// The contradiction in words.
    pub sentence: String,
    /// What the sensors that the clauses ask for take, each as the only stop.
    pub alone: Vec<Alone>,
}

/// A constraint that may be part of a conflict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Clause {
    /// A sub-region keeps its covers only where so many of these are served.
    Demand {
        /// A point inside the sub-region.
        at_m: [f64; 2],
        /// How many.
        needs: u32,
        /// The ids of the sensors that count.
        members: Vec<String>,
    },
    /// The request must be served.
    Required {
        /// Its sensor's id.
        sensor: String,
    },
    /// Charging must begin by then.
    Deadline {
        /// The sensor's id.
        sensor: String,
        /// The deadline.
        deadline_s: f64,
    },
    /// The energy delivered and travelled is bounded.
    Capacity {
        /// The bound.
        capacity_j: f64,
    },
    /// The arrival at the end is bounded.
    Timespan {
        /// The bound.
        timespan_s: f64,
    },
}

/// What a sensor takes as the only stop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alone {
    /// Its id.
    pub sensor: String,
    /// When charging begins.
    pub arrive_s: f64,
    /// Its deadline, if it has one.
    pub deadline_s: Option<f64>,
    /// When the charger is at the end.
    pub finish_s: f64,
    /// Energy delivered and travelled.
    pub energy_j: f64,
}

/// A limit that a changed tour would break.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Breach {
    /// Charging would begin too late.
    Deadline {
        /// The sensor's id.
        sensor: String,
        /// When it would begin.
        arrive_s: f64,
        /// Its deadline.
        deadline_s: f64,
    },
    /// It would take too much energy.
    Capacity {
        /// What it would take.
        energy_j: f64,
        /// The capacity.
        capacity_j: f64,
    },
    /// It would end too late.
    Timespan {
        /// When it would end.
        finish_s: f64,
        /// The time span.
        timespan_s: f64,
    },
}

/// A request that is not a stop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyUnserved {
    /// Its sensor's id.
    pub sensor: String,
    /// The reason in the plan.
    pub reason: Reason,
    /// What it takes as the only stop; null where it is already charged.
    pub alone: Option<Alone>,
    /// The cheapest place in the present tour: of those that break nothing the one with the least way, else
    /// the one that breaks least. Null where it is already charged, or the stop rule came first.
    pub insertion: Option<CheapestInsertion>,
}

/// A place in the tour, what it costs, and what it breaks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheapestInsertion {
    /// The sensor after which it would stand; null for the first stop.
    pub after: Option<String>,
    /// Way more than now.
    pub extra_m: f64,
    /// Later at the end than now.
    pub extra_s: f64,
    /// Energy more than now.
    pub extra_j: f64,
    /// What the tour would break then; empty if it fits.
    pub breaks: Vec<Breach>,
}

/// A stop: what would be without it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyServed {
    /// Its id.
    pub sensor: String,
    /// Whether it is `required`.
    pub required: bool,
    /// The sub-regions that would be short without it.
    pub short: Vec<Short>,
    /// What it contributes to the reward.
    pub reward: f64,
    /// Way that the tour would save without it; negative where the stop is a short cut.
    pub saves_m: f64,
    /// How much earlier the tour would end.
    pub saves_s: f64,
    /// Energy that the tour would save.
    pub saves_j: f64,
    /// Limits that the tour without it would break (only without the triangle inequality).
    pub breaks: Vec<Breach>,
}

/// A sub-region that would be short.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Short {
    /// A point inside it.
    pub at_m: [f64; 2],
    /// Served sensors that it needs of those that count.
    pub needs: u32,
    /// Those that it would have.
    pub has: u32,
}
