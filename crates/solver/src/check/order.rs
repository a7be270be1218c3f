//! From the names in a plan to the requests of the scenario.

use std::collections::HashMap;

use crate::plan::Plan;
use crate::scenario::{Request, Scenario};

use super::broken::{Findings, quote};

/// Which sensors there are, and which of them asks.
pub(super) struct Names<'a> {
    requests: HashMap<&'a str, Option<usize>>,
}

impl<'a> Names<'a> {
    pub(super) fn of(scenario: &'a Scenario) -> Self {
        let silent = scenario.sensors.iter().map(|sensor| (sensor.id.as_str(), None));
        let mut requests: HashMap<_, _> = silent.collect();
        for (i, request) in scenario.requests.iter().enumerate() {
            requests.insert(&scenario.sensors[request.sensor].id, Some(i));
        }
        Self { requests }
    }

    /// The request of a sensor; reports a sensor that is unknown or does not ask.
    pub(super) fn request(&self, path: &str, id: &str, findings: &mut Findings) -> Option<usize> {
        match self.requests.get(id) {
            Some(Some(request)) => return Some(*request),
            Some(None) => findings.add(path, &id, "the sensor has no request"),
            None => findings.add(path, &id, "no sensor of the scenario has this id"),
        }
        None
    }

    /// The requests that the stops serve, in order; none where the stops are no tour.
    pub(super) fn order(
        &self,
        scenario: &Scenario,
        plan: &Plan,
        findings: &mut Findings,
    ) -> Option<Vec<usize>> {
        let mut first_at = HashMap::new();
        let mut order = Vec::with_capacity(plan.stops.len());
        for (i, stop) in plan.stops.iter().enumerate() {
            let path = format!("stops[{i}].sensor");
            let Some(request) = self.request(&path, &stop.sensor, findings) else { continue };
            if let Some(first) = first_at.insert(request, i) {
                let rule = format!("served at most once; stops[{first}] serves it too");
                findings.add(path, &stop.sensor, rule);
            } else if already_charged(scenario, &scenario.requests[request]) {
                findings.add(path, &stop.sensor, "already charged: no candidate, never a stop");
            } else {
                order.push(request);
            }
        }
        (order.len() == plan.stops.len()).then_some(order)
    }
}

/// Compared in doubles, without tolerance, as the format says.
pub(super) fn already_charged(scenario: &Scenario, request: &Request) -> bool {
    request.residual_j >= scenario.charge_level * scenario.sensors[request.sensor].battery_j
}

/// The id of a request's sensor, as JSON.
pub(super) fn quoted_id(scenario: &Scenario, request: usize) -> String {
    quote(&scenario.sensors[scenario.requests[request].sensor].id)
}
