//! [`NextChange`]: a change of the scenario and what it buys, field for field.

use serde::{Deserialize, Serialize};

/// A change of the scenario and what it buys. Everything else, what was derived from a default included, stays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NextChange {
    /// What changes.
    pub change: Change,
    /// What that buys.
    pub buys: Buys,
    /// The tour that does it, as sensors in order: a plan of it passed the check of the changed scenario.
    pub tour: Vec<String>,
    /// The largest value of which is proven that it does not do; null where nothing is proven.
    pub too_little: Option<f64>,
    /// Whether the change is the least that does, to one per cent; otherwise it is only known to suffice.
    pub proven: bool,
}

/// One number of the scenario, raised.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Change {
    /// `charger.capacity_j`.
    Capacity {
        /// Now.
        from_j: f64,
        /// Then.
        to_j: f64,
    },
    /// `charger.timespan_s`.
    Timespan {
        /// Now.
        from_s: f64,
        /// Then.
        to_s: f64,
    },
    /// `charger.speed_mps`.
    Speed {
        /// Now.
        from_mps: f64,
        /// Then.
        to_mps: f64,
    },
    /// The deadline of a request.
    Deadline {
        /// Its sensor's id.
        sensor: String,
        /// Now.
        from_s: f64,
        /// Then.
        to_s: f64,
    },
}

/// What a change buys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Buys {
    /// A tour that keeps every constraint.
    Feasible,
    /// One more stop.
    Stop {
        /// The sensor that is served then.
        sensor: String,
        /// Value of the tour now.
        from: f64,
        /// Value of the tour then.
        to: f64,
    },
    /// A shorter tour.
    Shorter {
        /// Length now.
        from_m: f64,
        /// Length then.
        to_m: f64,
    },
}
