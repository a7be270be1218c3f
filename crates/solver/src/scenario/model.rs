//! The validated scenario. Its values are what the format allows, with every default filled in;
//! only [`Scenario::from_json`] and [`Scenario::from_document`] make one.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use super::document::Document;
use super::{Polygon, ScenarioError, json, read, validate};

/// A place in the plane, in metres.
pub type Point = Point2<f64>;

/// What the tour optimises, and how ties are broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// The length of start, stops, end.
    MinDistance,
    /// The sum of the served rewards; among equals the shorter tour.
    MaxReward,
    /// The number served; among equals the earlier finish.
    MaxCount,
}

impl Objective {
    /// The objective of that name in a document.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "min_distance" => Some(Self::MinDistance),
            "max_reward" => Some(Self::MaxReward),
            "max_count" => Some(Self::MaxCount),
            _ => None,
        }
    }

    /// The name in a document.
    pub fn name(self) -> &'static str {
        match self {
            Self::MinDistance => "min_distance",
            Self::MaxReward => "max_reward",
            Self::MaxCount => "max_count",
        }
    }
}

/// One departure of one charger.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Scenario {
    /// The document's name.
    pub name: Option<String>,
    /// What the tour optimises.
    pub objective: Objective,
    /// The charger.
    pub charger: Charger,
    /// Fraction of the battery to charge to, in (0, 1].
    pub charge_level: f64,
    /// The coverage constraint, if there is one; then every sensor is at rest and has a range.
    pub coverage: Option<Coverage>,
    /// All sensors alive, in document order.
    pub sensors: Vec<Sensor>,
    /// The requests, in document order; at most one a sensor.
    pub requests: Vec<Request>,
    /// Travel distances, where they are not Euclidean.
    pub travel: Option<DistanceMatrix>,
}

/// The mobile charger (paper, section "Optimal k-coverage Charging Problem", network model).
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Charger {
    /// Where it leaves at time 0.
    pub start_m: Point,
    /// Where it must end.
    pub end_m: Point,
    /// Speed, > 0, and greater than that of any sensor.
    pub speed_mps: f64,
    /// Energy travelled per metre, >= 0.
    pub travel_jpm: f64,
    /// Charging power, > 0.
    pub transfer_w: f64,
    /// Bound on energy delivered plus energy travelled.
    pub capacity_j: Option<f64>,
    /// Bound on the arrival at `end_m`.
    pub timespan_s: Option<f64>,
}

/// The coverage constraint.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Coverage {
    /// Covers that every point of the field must keep, >= 1. A larger number than there are
    /// sensors is kept as `u32::MAX` at most.
    pub k: u32,
    /// The field of interest.
    pub field: Polygon,
}

/// A sensor.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Sensor {
    /// Free text, unique in the scenario.
    pub id: String,
    /// Where it is.
    pub place: Place,
    /// Radius of its closed sensing disk, > 0; always there under a coverage constraint.
    pub range_m: Option<f64>,
    /// Capacity of its battery, > 0.
    pub battery_j: f64,
}

/// Where a sensor is.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// At rest.
    Fixed(Point),
    /// Moving along a known trajectory.
    Moving(Trajectory),
}

impl Place {
    /// The place at a time.
    pub fn at(&self, time_s: f64) -> Point {
        match self {
            Self::Fixed(point) => *point,
            Self::Moving(trajectory) => trajectory.at(time_s),
        }
    }
}

/// A row of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// When, in seconds after the departure; may be negative.
    pub time_s: f64,
    /// Where.
    pub position_m: Point,
}

/// Linear between its waypoints, at rest before the first and after the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    waypoints: Vec<Waypoint>,
    /// Equal parts of the time between the first and the last waypoint, as many as waypoints, in a second.
    parts_per_s: f64,
    /// By part, and last by the end, how many waypoints lie in earlier ones.
    before: Vec<u32>,
}

impl Trajectory {
    /// Only for the validation, which has made sure of at least one row and of rising times.
    pub(super) fn new(waypoints: Vec<Waypoint>) -> Self {
        let ends = waypoints.first().zip(waypoints.last());
        let seconds = ends.map_or(0.0, |(first, last)| last.time_s - first.time_s);
        let parts_per_s = if seconds > 0.0 { waypoints.len() as f64 / seconds } else { 0.0 };
        let mut trajectory = Self { waypoints, parts_per_s, before: Vec::new() };
        let parts: Vec<usize> =
            trajectory.waypoints.iter().map(|row| trajectory.part(row.time_s)).collect();
        let before = |part| parts.partition_point(|&other| other < part) as u32;
        trajectory.before = (0..=parts.len()).map(before).collect();
        trajectory
    }

    /// At least one waypoint, times strictly rising.
    pub fn waypoints(&self) -> &[Waypoint] {
        &self.waypoints
    }

    /// The place at a time.
    pub fn at(&self, time_s: f64) -> Point {
        self.behind(self.passed(time_s), time_s)
    }

    /// How many waypoints have been passed at a time.
    pub fn passed(&self, time_s: f64) -> usize {
        // No later time lies in an earlier part, however it is rounded: only rows of the same part decide.
        let part = self.part(time_s);
        let (first, last) = (self.before[part] as usize, self.before[part + 1] as usize);
        first + self.waypoints[first..last].partition_point(|row| row.time_s <= time_s)
    }

    /// The place at a time at which so many waypoints have been passed.
    pub fn behind(&self, passed: usize, time_s: f64) -> Point {
        match (passed.checked_sub(1).map(|i| self.waypoints[i]), self.waypoints.get(passed)) {
            (None, Some(first)) => first.position_m,
            (Some(last), None) => last.position_m,
            (Some(a), Some(b)) => {
                let share = (time_s - a.time_s) / (b.time_s - a.time_s);
                a.position_m + (b.position_m - a.position_m) * share
            }
            (None, None) => Point::origin(),
        }
    }

    fn part(&self, time_s: f64) -> usize {
        let first_s = self.waypoints.first().map_or(0.0, |first| first.time_s);
        // Negative, before the first, becomes none.
        let part = ((time_s - first_s) * self.parts_per_s) as usize;
        part.min(self.waypoints.len().saturating_sub(1))
    }
}

/// A charging request (paper: id, position, deadline).
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Request {
    /// Index into [`Scenario::sensors`].
    pub sensor: usize,
    /// Charging may not begin before it, >= 0.
    pub ready_s: f64,
    /// Charging must begin at or before it.
    pub deadline_s: Option<f64>,
    /// Consumption, >= 0.
    pub drain_w: f64,
    /// Energy left at time 0, 0 to battery.
    pub residual_j: f64,
    /// What serving it is worth, >= 0.
    pub reward: f64,
    /// The tour must serve it.
    pub required: bool,
}

/// Travel distances between start (0), end (1) and the requests (2 + index), row to column.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMatrix {
    size: usize,
    distance_m: Vec<f64>,
}

impl DistanceMatrix {
    pub(super) fn new(size: usize, distance_m: Vec<f64>) -> Self {
        Self { size, distance_m }
    }

    /// Requests plus two.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Distance in metres; may be asymmetric and break the triangle inequality.
    pub fn get(&self, from: usize, to: usize) -> f64 {
        self.distance_m[from * self.size + to]
    }
}

impl Scenario {
    /// Parses and validates a document.
    ///
    /// # Errors
    /// The first rule that the text breaks, with JSON path, value and rule.
    pub fn from_json(text: &[u8]) -> Result<Self, ScenarioError> {
        Self::from_document(&read::document(&json::parse(text)?)?)
    }

    /// Validates a document that is already in memory.
    ///
    /// # Errors
    /// The first rule that the document breaks, with JSON path, value and rule.
    pub fn from_document(document: &Document) -> Result<Self, ScenarioError> {
        validate::scenario(document)
    }

    /// The energy to which a request's battery is charged: `charge_level` x battery, in joules.
    pub fn target_j(&self, request: &Request) -> f64 {
        self.charge_level * self.sensors[request.sensor].battery_j
    }

    /// Whether a request is already charged: no candidate, never a stop (compared in doubles, without
    /// tolerance).
    pub fn already_charged(&self, request: &Request) -> bool {
        request.residual_j >= self.target_j(request)
    }
}
