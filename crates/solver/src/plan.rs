//! The plan document: the answer to one scenario, exactly the fields of the format and no others.

use serde::{Deserialize, Serialize};

use crate::scenario::{Reader, ScenarioError, parse_json};

/// The only value of the field `format`.
pub const FORMAT: &str = "voltour/plan/1";

/// A plan. Units are in the field names: metres, seconds, joules.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Always [`FORMAT`].
    pub format: String,
    /// The scenario's name.
    pub scenario: Option<String>,
    /// What is known of the tour.
    pub status: Status,
    /// The solver whose tour it is.
    pub solver: String,
    /// Value of the tour shown, in the unit of the objective.
    pub objective: f64,
    /// Proven bound: no feasible tour is better by more than the tolerance.
    pub bound: Option<f64>,
    /// Length of start, stops, end.
    pub distance_m: f64,
    /// Energy travelled.
    pub travel_j: f64,
    /// Energy delivered.
    pub charge_j: f64,
    /// Arrival at the end.
    pub finish_s: f64,
    /// In the order of the tour.
    pub stops: Vec<Stop>,
    /// Every request that is not a stop, once, in document order.
    pub unserved: Vec<Unserved>,
    /// What an infeasible tour breaks.
    pub violations: Vec<Violation>,
    /// What the deployment cannot give, whatever the tour.
    pub warnings: Vec<Warning>,
    /// Time that the planning took.
    pub elapsed_s: f64,
}

/// What is known of a plan's tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Feasible, and the bound proves the objective.
    Optimal,
    /// Feasible.
    Feasible,
    /// No feasible tour was found, none is ruled out.
    BestEffort,
    /// Proven: no feasible tour exists.
    Infeasible,
}

impl Status {
    /// Whether the tour keeps every constraint.
    pub fn is_feasible(self) -> bool {
        matches!(self, Self::Optimal | Self::Feasible)
    }

    /// The name in a document.
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Feasible => "feasible",
            Self::BestEffort => "best_effort",
            Self::Infeasible => "infeasible",
        }
    }

    fn from_name(name: &str) -> Option<Self> {
        [Self::Optimal, Self::Feasible, Self::BestEffort, Self::Infeasible]
            .into_iter()
            .find(|status| status.name() == name)
    }
}

/// A sensor charged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stop {
    /// Its id.
    pub sensor: String,
    /// Where it is met.
    pub position_m: [f64; 2],
    /// When charging begins.
    pub arrive_s: f64,
    /// When the charger leaves.
    pub depart_s: f64,
    /// Energy delivered.
    pub charge_j: f64,
}

/// A request that is not a stop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unserved {
    /// Its sensor's id.
    pub sensor: String,
    /// Why.
    pub reason: Reason,
}

/// Why a request is not a stop: the first that holds, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Its residual energy is at the charge level already.
    AlreadyCharged,
    /// Its deadline, or the time span, cannot be met even as the only stop.
    Unreachable,
    /// The capacity cannot pay for it even as the only stop.
    NoCapacity,
    /// Under `min_distance`: the tour is as good without it.
    NotNeeded,
    /// The tour does without it.
    NotChosen,
}

impl Reason {
    /// The name in a document.
    pub fn name(self) -> &'static str {
        match self {
            Self::AlreadyCharged => "already_charged",
            Self::Unreachable => "unreachable",
            Self::NoCapacity => "no_capacity",
            Self::NotNeeded => "not_needed",
            Self::NotChosen => "not_chosen",
        }
    }

    fn from_name(name: &str) -> Option<Self> {
        use Reason::{AlreadyCharged, NoCapacity, NotChosen, NotNeeded, Unreachable};
        [AlreadyCharged, Unreachable, NoCapacity, NotNeeded, NotChosen]
            .into_iter()
            .find(|reason| reason.name() == name)
    }
}

/// A constraint that the tour shown breaks.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Violation {
    /// A required request is not served.
    Required {
        /// Its sensor's id.
        sensor: String,
    },
    /// A set of covering sensors falls short.
    Coverage {
        /// A point inside the sub-region.
        at_m: [f64; 2],
        /// Covers that it must keep: min(k, c).
        needs: u32,
        /// Covers that it keeps.
        has: u32,
    },
    /// Even the empty trip ends too late.
    Timespan {
        /// The time span.
        limit: f64,
        /// Time of the empty trip.
        needs: f64,
    },
    /// Even the empty trip takes too much energy.
    Capacity {
        /// The capacity.
        limit: f64,
        /// Energy of the empty trip.
        needs: f64,
    },
}

/// What the deployment cannot give.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Warning {
    /// A set of covering sensors that is smaller than k.
    BelowK {
        /// A point inside the sub-region.
        at_m: [f64; 2],
        /// k.
        needs: u32,
        /// Sensors that cover it.
        has: u32,
    },
}

impl Plan {
    /// Parses a plan document; strict in its fields and types, silent on whether the plan holds,
    /// which is the business of [`crate::check`].
    ///
    /// # Errors
    /// The first field that is not as the format says.
    pub fn from_json(text: &[u8]) -> Result<Self, ScenarioError> {
        read::plan(Reader::root(&parse_json(text)?))
    }
}

mod read {
    //! From a JSON tree to [`Plan`].

    use super::{
        FORMAT, Plan, Reader, Reason, ScenarioError, Status, Stop, Unserved, Violation, Warning,
    };

    type Read<T> = Result<T, ScenarioError>;

    pub(super) fn plan(reader: Reader<'_>) -> Read<Plan> {
        const KNOWN: [&str; 15] = [
            "format",
            "scenario",
            "status",
            "solver",
            "objective",
            "bound",
            "distance_m",
            "travel_j",
            "charge_j",
            "finish_s",
            "stops",
            "unserved",
            "violations",
            "warnings",
            "elapsed_s",
        ];
        let fields = reader.fields(&KNOWN)?;
        // These two may be null, but they must be there.
        for name in ["scenario", "bound"] {
            if !fields.stands(name) {
                return Err(ScenarioError::missing(fields.path_of(name), "required, null if none"));
            }
        }
        let number = |name| fields.required(name, |v| v.number());
        Ok(Plan {
            format: fields.required("format", format)?,
            scenario: fields.optional("scenario", |v| v.text())?,
            status: fields.required("status", status)?,
            solver: fields.required("solver", |v| v.text())?,
            objective: number("objective")?,
            bound: fields.optional("bound", |v| v.number())?,
            distance_m: number("distance_m")?,
            travel_j: number("travel_j")?,
            charge_j: number("charge_j")?,
            finish_s: number("finish_s")?,
            stops: fields.required("stops", |v| v.list(stop))?,
            unserved: fields.required("unserved", |v| v.list(unserved))?,
            violations: fields.required("violations", |v| v.list(violation))?,
            warnings: fields.required("warnings", |v| v.list(warning))?,
            elapsed_s: number("elapsed_s")?,
        })
    }

    fn format(reader: Reader<'_>) -> Read<String> {
        let text = reader.text()?;
        if text == FORMAT { Ok(text) } else { Err(reader.wrong(&format!("must be \"{FORMAT}\""))) }
    }

    fn status(reader: Reader<'_>) -> Read<Status> {
        Status::from_name(&reader.text()?)
            .ok_or_else(|| reader.wrong("must be optimal, feasible, best_effort or infeasible"))
    }

    fn reason(reader: Reader<'_>) -> Read<Reason> {
        Reason::from_name(&reader.text()?).ok_or_else(|| {
            reader.wrong(
                "must be already_charged, unreachable, no_capacity, not_needed or not_chosen",
            )
        })
    }

    fn stop(reader: Reader<'_>) -> Read<Stop> {
        let fields =
            reader.fields(&["sensor", "position_m", "arrive_s", "depart_s", "charge_j"])?;
        Ok(Stop {
            sensor: fields.required("sensor", |v| v.text())?,
            position_m: fields.required("position_m", |v| v.row())?,
            arrive_s: fields.required("arrive_s", |v| v.number())?,
            depart_s: fields.required("depart_s", |v| v.number())?,
            charge_j: fields.required("charge_j", |v| v.number())?,
        })
    }

    fn unserved(reader: Reader<'_>) -> Read<Unserved> {
        let fields = reader.fields(&["sensor", "reason"])?;
        Ok(Unserved {
            sensor: fields.required("sensor", |v| v.text())?,
            reason: fields.required("reason", reason)?,
        })
    }

    fn whole(reader: Reader<'_>) -> Read<u32> {
        let number = reader.number()?;
        let whole = number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0;
        if whole { Ok(number as u32) } else { Err(reader.wrong("must be a whole number >= 0")) }
    }

    fn violation(reader: Reader<'_>) -> Read<Violation> {
        let kind = kind(&reader, &["required", "coverage", "timespan", "capacity"])?;
        match kind {
            "required" => {
                let fields = reader.fields(&["kind", "sensor"])?;
                Ok(Violation::Required { sensor: fields.required("sensor", |v| v.text())? })
            }
            "coverage" => {
                let fields = reader.fields(&["kind", "at_m", "needs", "has"])?;
                Ok(Violation::Coverage {
                    at_m: fields.required("at_m", |v| v.row())?,
                    needs: fields.required("needs", whole)?,
                    has: fields.required("has", whole)?,
                })
            }
            _ => {
                let fields = reader.fields(&["kind", "limit", "needs"])?;
                let limit = fields.required("limit", |v| v.number())?;
                let needs = fields.required("needs", |v| v.number())?;
                Ok(match kind {
                    "timespan" => Violation::Timespan { limit, needs },
                    _ => Violation::Capacity { limit, needs },
                })
            }
        }
    }

    fn warning(reader: Reader<'_>) -> Read<Warning> {
        kind(&reader, &["below_k"])?;
        let fields = reader.fields(&["kind", "at_m", "needs", "has"])?;
        Ok(Warning::BelowK {
            at_m: fields.required("at_m", |v| v.row())?,
            needs: fields.required("needs", whole)?,
            has: fields.required("has", whole)?,
        })
    }

    /// The member `kind`, one of those allowed; it decides which other members there are.
    fn kind(reader: &Reader<'_>, allowed: &[&'static str]) -> Read<&'static str> {
        reader.peek("kind", |value| {
            let text = value.text()?;
            let found = allowed.iter().find(|kind| **kind == text);
            let rule = || format!("must be {}", allowed.join(", "));
            found.copied().ok_or_else(|| value.wrong(&rule()))
        })
    }
}
