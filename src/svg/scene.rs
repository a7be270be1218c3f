//! What there is to draw: the scenario's sensors, each with what the plan does about it.

use std::collections::HashMap;

use voltour_solver::plan::{Plan, Reason, Stop};
use voltour_solver::scenario::{Place, Request, Scenario, Sensor};

use super::view::View;

/// Past so many sensors, marks are merged and have no tooltips.
pub(super) const MANY: usize = 3000;

/// What the plan does about a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// It asked for nothing.
    Idle,
    /// It is this stop of the tour, from 0.
    Stop(usize),
    /// It asked and is no stop.
    Unserved(Reason),
}

/// A scenario and its plan, joined.
pub(super) struct Scene<'a> {
    pub scenario: &'a Scenario,
    pub plan: &'a Plan,
    /// By sensor.
    pub roles: Vec<Role>,
    /// By sensor: its request.
    requests: Vec<Option<usize>>,
    by_id: HashMap<&'a str, usize>,
    pub view: View,
}

impl<'a> Scene<'a> {
    /// Joins by sensor id; what only the plan knows of is left out but for its stops.
    pub fn new(scenario: &'a Scenario, plan: &'a Plan) -> Self {
        let ids = scenario.sensors.iter().enumerate();
        let by_id: HashMap<_, _> = ids.map(|(i, sensor)| (sensor.id.as_str(), i)).collect();
        let mut roles = vec![Role::Idle; scenario.sensors.len()];
        let mut requests = vec![None; scenario.sensors.len()];
        for (i, request) in scenario.requests.iter().enumerate() {
            roles[request.sensor] = Role::Unserved(Reason::NotChosen);
            requests[request.sensor] = Some(i);
        }
        for unserved in &plan.unserved {
            if let Some(&i) = by_id.get(unserved.sensor.as_str()) {
                roles[i] = Role::Unserved(unserved.reason);
            }
        }
        for (order, stop) in plan.stops.iter().enumerate() {
            if let Some(&i) = by_id.get(stop.sensor.as_str()) {
                roles[i] = Role::Stop(order);
            }
        }
        let view = View::of(points(scenario, plan));
        Self { scenario, plan, roles, requests, by_id, view }
    }

    /// Every sensor with its role.
    pub fn sensors(&self) -> impl Iterator<Item = (&'a Sensor, Role)> {
        self.scenario.sensors.iter().zip(self.roles.iter().copied())
    }

    /// The sensor of a stop, where the scenario has it.
    pub fn sensor_of(&self, stop: &Stop) -> Option<&'a Sensor> {
        self.by_id.get(stop.sensor.as_str()).map(|&i| &self.scenario.sensors[i])
    }

    /// The request of a sensor by its id.
    pub fn request_of(&self, sensor: &str) -> Option<&'a Request> {
        let request = self.requests[*self.by_id.get(sensor)?]?;
        self.scenario.requests.get(request)
    }

    /// Whether there are too many sensors to draw each on its own.
    pub fn is_crowded(&self) -> bool {
        self.scenario.sensors.len() > MANY
    }
}

impl Role {
    /// Whether the sensor still works when the tour is over.
    pub fn is_alive(self) -> bool {
        !matches!(self, Self::Unserved(reason) if reason != Reason::AlreadyCharged)
    }
}

/// Until when moving sensors are followed: as long as anything of interest happens.
pub(super) fn horizon(scenario: &Scenario, plan: &Plan) -> f64 {
    let finish = if plan.finish_s.is_finite() { plan.finish_s.max(0.0) } else { 0.0 };
    finish.max(scenario.charger.timespan_s.unwrap_or(0.0))
}

fn points<'a>(scenario: &'a Scenario, plan: &'a Plan) -> impl Iterator<Item = [f64; 2]> + 'a {
    let until = horizon(scenario, plan);
    let charger =
        [scenario.charger.start_m, scenario.charger.end_m].into_iter().map(<[f64; 2]>::from);
    let field = scenario.coverage.iter().flat_map(|c| c.field.corners()).map(|&p| p.into());
    let sensors = scenario.sensors.iter().flat_map(move |sensor| {
        let ways = match &sensor.place {
            Place::Fixed(_) => &[][..],
            Place::Moving(trajectory) => trajectory.waypoints(),
        };
        let between = ways.iter().filter(move |w| w.time_s > 0.0 && w.time_s < until);
        let ends = [sensor.place.at(0.0), sensor.place.at(until)];
        ends.into_iter().chain(between.map(|w| w.position_m)).map(<[f64; 2]>::from)
    });
    charger.chain(field).chain(sensors).chain(plan.stops.iter().map(|stop| stop.position_m))
}
