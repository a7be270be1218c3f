//! From a batch to the scenario document: sensors alive, requests aged to second 0.

use std::collections::HashMap;

use jiff::Timestamp;
use voltour_solver::scenario::{
    ChargerDocument, Document, RequestDocument, Scenario, ScenarioError,
};

use crate::clock::seconds;
use crate::domain::{Announcement, Place, Request, Sensor, SensorId, documents};
use crate::store::Batch;

/// The scenario of a batch. A network may have changed since a request was judged: where the scenario
/// is refused for that, everything is taken to stand where it is at second 0.
pub(super) fn scenario(batch: &Batch) -> Result<(Document, Scenario), ScenarioError> {
    let mut document = document(batch);
    if batch.network.spec.coverage.is_some() {
        stand_still(&mut document);
    }
    match Scenario::from_document(&document) {
        Ok(scenario) => Ok((document, scenario)),
        Err(error) => {
            let departure = batch.departure.id;
            tracing::warn!(%departure, %error, "no scenario: moving sensors taken to stand still");
            stand_still(&mut document);
            let scenario = Scenario::from_document(&document)?;
            Ok((document, scenario))
        }
    }
}

fn document(batch: &Batch) -> Document {
    let asked: HashMap<&SensorId, &Request> =
        batch.requests.iter().map(|request| (&request.asked.sensor_id, request)).collect();
    let spec = &batch.network.spec;
    let alive =
        |sensor: &&Sensor| asked.contains_key(&sensor.id) || !batch.dead.contains(&sensor.id);
    let sensor = |sensor: &Sensor| {
        let asked = asked.get(&sensor.id).and_then(|request| request.asked.place.clone());
        let updated = || batch.paths.get(&sensor.id).cloned().map(Place::Trajectory);
        let place = asked.or_else(updated).unwrap_or_else(|| sensor.place.clone());
        documents::sensor(sensor, &place, batch.start)
    };
    let mut document = documents::document(spec, charger(batch));
    document.name = Some(batch.departure.id.to_string());
    document.sensors = spec.sensors.iter().filter(alive).map(sensor).collect();
    document.requests =
        batch.requests.iter().map(|request| self::request(batch, request)).collect();
    document
}

/// The charger's type, with what was announced in its place.
fn charger(batch: &Batch) -> ChargerDocument {
    let Announcement { start_m, end_m, capacity_j, timespan_s, .. } = &batch.departure.announced;
    let kind = documents::charger(&batch.kind);
    ChargerDocument {
        start_m: start_m.unwrap_or(kind.start_m),
        end_m: end_m.or(kind.end_m),
        capacity_j: capacity_j.or(kind.capacity_j),
        timespan_s: timespan_s.or(kind.timespan_s),
        ..kind
    }
}

fn request(batch: &Batch, request: &Request) -> RequestDocument {
    let (asked, start) = (&request.asked, batch.start);
    let sensor = batch.network.sensor(&asked.sensor_id);
    let after = |at: Timestamp| seconds(start, at).max(0.0);
    let drain_w = asked.drain_w.or(sensor.and_then(|sensor| sensor.drain_w));
    let battery_j = sensor.map_or(f64::INFINITY, |sensor| sensor.battery_j);
    let measured_at = asked.measured_at.unwrap_or(request.received_at);
    let aged = |residual_j: f64| {
        // What was measured at a time to come, by a clock that was ahead, has not grown since.
        let drained = drain_w.unwrap_or(0.0) * seconds(measured_at, start).max(0.0);
        (residual_j - drained).clamp(0.0, battery_j)
    };
    RequestDocument {
        sensor: asked.sensor_id.to_string(),
        ready_s: asked.ready.map(after).filter(|ready_s| *ready_s > 0.0),
        deadline_s: asked.deadline.map(after),
        residual_j: asked.residual_j.map(aged),
        drain_w,
        reward: asked.reward,
        required: asked.required.then_some(true),
    }
}

fn stand_still(document: &mut Document) {
    for sensor in &mut document.sensors {
        if let Some(rows) = sensor.trajectory.take() {
            sensor.position_m = Some(at_start(&rows));
        }
    }
}

/// Where a trajectory is at second 0.
fn at_start(rows: &[[f64; 3]]) -> [f64; 2] {
    let after = rows.partition_point(|[time_s, ..]| *time_s <= 0.0);
    match (after.checked_sub(1).and_then(|i| rows.get(i)), rows.get(after)) {
        (Some([t, x, y]), Some([u, v, w])) => {
            let share = -t / (u - t);
            [x + share * (v - x), y + share * (w - y)]
        }
        (Some([_, x, y]), None) | (None, Some([_, x, y])) => [*x, *y],
        (None, None) => [0.0, 0.0],
    }
}
