//! Tours, what chargers report of them, and where a plan came from.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use voltour_solver::plan::Status;

use super::{
    ChargerId, ClientId, DepartureId, NetworkId, PlanId, RequestId, SensorId, TourId, VisitId,
};

/// Where a tour is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TourState {
    /// To be driven, or being driven.
    Out,
    /// The charger reported its end.
    Completed,
    /// Nothing was heard for long after the planned finish.
    Overdue,
    /// Called back.
    Cancelled,
}

/// What became of a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The sensor was charged.
    Charged,
    /// The charger did not go there.
    Skipped,
    /// The charger could not charge it.
    Failed,
}

/// A tour as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tour {
    /// Its id.
    pub id: TourId,
    /// Where it is in its life.
    pub state: TourState,
    /// The network.
    pub network_id: NetworkId,
    /// The charger.
    pub charger_id: ChargerId,
    /// The departure.
    pub departure_id: DepartureId,
    /// The plan.
    pub plan_id: PlanId,
    /// Of the plan among those of its departure, from 1.
    pub revision: u32,
    /// Of the tour among those of its plan, from 1.
    pub number: u32,
    /// What is known of the plan.
    pub status: Status,
    /// Second 0.
    pub start: Timestamp,
    /// When the charger reaches its end.
    pub finish: Timestamp,
    /// Where it leaves.
    pub start_m: [f64; 2],
    /// Where it ends.
    pub end_m: [f64; 2],
    /// In driving order.
    pub stops: Vec<Stop>,
    /// Length.
    pub distance_m: f64,
    /// Energy travelled.
    pub travel_j: f64,
    /// Energy delivered.
    pub charge_j: f64,
    /// The solver whose tour it is.
    pub solver: String,
    /// Value of the tour.
    pub objective: f64,
    /// Proven bound.
    pub bound: Option<f64>,
    /// How far the tour may be from the best: of the objective to the bound.
    pub gap: Option<f64>,
    /// When it last changed.
    pub updated_at: Timestamp,
    /// Rises with every change of the database.
    #[serde(skip)]
    pub change: u64,
}

/// A stop of a tour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stop {
    /// The sensor.
    pub sensor_id: SensorId,
    /// The request that it serves.
    pub request_id: RequestId,
    /// Where the sensor is met.
    pub position_m: [f64; 2],
    /// When charging begins.
    pub arrive: Timestamp,
    /// When it ends.
    pub depart: Timestamp,
    /// Energy delivered.
    pub charge_j: f64,
    /// What was reported last.
    pub outcome: Option<Outcome>,
}

/// A charger's report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NewVisit {
    /// The tour that it is on.
    pub tour_id: TourId,
    /// The sensor.
    pub sensor_id: SensorId,
    /// What became of it.
    pub outcome: Outcome,
    /// When charging began.
    pub arrived_at: Option<Timestamp>,
    /// When it ended.
    pub departed_at: Option<Timestamp>,
    /// Energy delivered.
    pub charge_j: Option<f64>,
    /// Anything else.
    pub note: Option<String>,
}

/// A report as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Visit {
    /// Its id.
    pub id: VisitId,
    /// The client's id for the call that made it.
    pub client_id: ClientId,
    /// What was reported.
    #[serde(flatten)]
    pub reported: NewVisit,
    /// When it was received.
    pub received_at: Timestamp,
    /// The requests that it served.
    pub served: Vec<RequestId>,
}

/// Where a plan came from; stored and shown beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The solver asked for.
    pub asked: String,
    /// Each contender with its tour's value and time.
    pub contenders: Vec<Contender>,
    /// Whose tour it is.
    pub winner: String,
    /// How far it may be from the best: of its objective to its bound, where it has one.
    #[serde(default)]
    pub gap: Option<f64>,
    /// The policy that was asked for values, where one was.
    pub policy: Option<PolicyUsed>,
    /// Why the plan was made without the policy (`policy: REASON: ...`), and why contenders were refused.
    pub fallback_reason: Option<String>,
    /// The seed.
    pub seed: u64,
    /// Iterations done in all: `voltour solve --seed S --iterations N` gives the same tour again.
    pub iterations: u64,
    /// Iterations done in each phase.
    pub phases: Vec<PhaseIterations>,
    /// The versions of what made it.
    pub versions: Versions,
    /// Second 0.
    pub start: Timestamp,
    /// The requests of the batch, in the order of the scenario.
    pub batch: Vec<RequestId>,
    /// What the independent check said: `holds`, or the rules broken by refused contenders.
    pub check: Vec<String>,
}

/// A solver's tour in a contest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contender {
    /// Its name.
    pub solver: String,
    /// Its tour's value.
    pub objective: f64,
    /// What is known of its tour.
    pub status: String,
    /// Time that it took.
    pub elapsed_s: Option<f64>,
    /// Iterations that it did.
    pub iterations: u64,
}

/// A policy, by name and digest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PolicyUsed {
    /// Its name.
    pub name: String,
    /// SHA-256 of its file, in hexadecimal.
    pub digest: String,
    /// The problem that it is trained for.
    pub problem: String,
    /// The version of the features that it takes.
    pub feature_version: u32,
}

/// Iterations of one phase of a solver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhaseIterations {
    /// The phase.
    pub phase: String,
    /// Whole iterations.
    pub iterations: u64,
}

/// The versions of what made a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Versions {
    /// Of voltour.
    pub voltour: String,
    /// Of the scenario format.
    pub scenario_format: String,
    /// Of the network.
    pub network: u64,
}
