//! The rules of the format, one function a part of the document. Each refusal names path, value
//! and rule; each default is filled in here and nowhere else.

use std::collections::HashMap;

use super::document::{
    ChargerDocument, CoverageDocument, Document, FORMAT, RequestDocument, SensorDocument,
};
use super::model::{
    Charger, Coverage, DistanceMatrix, Place, Point, Request, Scenario, Sensor, Trajectory,
    Waypoint,
};
use super::{Polygon, ScenarioError};

type Valid<T> = Result<T, ScenarioError>;

const LONGEST_ID: usize = 128;

pub(super) fn scenario(document: &Document) -> Valid<Scenario> {
    if document.format != FORMAT {
        return Err(ScenarioError::rule(
            "format",
            &document.format,
            format!("must be \"{FORMAT}\""),
        ));
    }
    let charger = charger(&document.charger)?;
    let charge_level = document.charge_level.unwrap_or(1.0);
    if !(charge_level > 0.0 && charge_level <= 1.0) {
        return Err(ScenarioError::rule("charge_level", &charge_level, "must be in (0, 1]"));
    }
    let coverage = document.coverage.as_ref().map(coverage).transpose()?;
    let sensors = sensors(document, &charger)?;
    let requests = requests(document, charge_level)?;
    let travel = travel(document)?;
    Ok(Scenario {
        name: document.name.clone(),
        objective: document.objective,
        charger,
        charge_level,
        coverage,
        sensors,
        requests,
        travel,
    })
}

fn charger(document: &ChargerDocument) -> Valid<Charger> {
    let start_m = point("charger.start_m", document.start_m)?;
    let end_m = document.end_m.map_or(Ok(start_m), |end| point("charger.end_m", end))?;
    Ok(Charger {
        start_m,
        end_m,
        speed_mps: positive("charger.speed_mps", document.speed_mps)?,
        travel_jpm: not_negative("charger.travel_jpm", document.travel_jpm)?,
        transfer_w: positive("charger.transfer_w", document.transfer_w)?,
        capacity_j: optional(document.capacity_j, |x| not_negative("charger.capacity_j", x))?,
        timespan_s: optional(document.timespan_s, |x| not_negative("charger.timespan_s", x))?,
    })
}

fn coverage(document: &CoverageDocument) -> Valid<Coverage> {
    let k = document.k;
    if !(k >= 1.0 && k.fract() == 0.0 && k.is_finite()) {
        return Err(ScenarioError::rule("coverage.k", &k, "must be a whole number >= 1"));
    }
    let corner = |(i, xy): (usize, &[f64; 2])| point(format!("coverage.field_m[{i}]"), *xy);
    let corners = document.field_m.iter().enumerate().map(corner).collect::<Valid<Vec<_>>>()?;
    let field = Polygon::new(corners)
        .map_err(|rule| ScenarioError::rule("coverage.field_m", &document.field_m, rule))?;
    // The cast saturates; no scenario has more sensors than u32::MAX.
    Ok(Coverage { k: k as u32, field })
}

fn sensors(document: &Document, charger: &Charger) -> Valid<Vec<Sensor>> {
    let mut first_at = HashMap::new();
    let mut sensors = Vec::with_capacity(document.sensors.len());
    for (i, sensor) in document.sensors.iter().enumerate() {
        let path = format!("sensors[{i}]");
        let id = &sensor.id;
        if id.is_empty() || id.len() > LONGEST_ID {
            let rule = format!("must have 1 to {LONGEST_ID} bytes");
            return Err(ScenarioError::rule(format!("{path}.id"), id, rule));
        }
        if let Some(first) = first_at.insert(id.as_str(), i) {
            let rule = format!("must be unique; sensors[{first}] has it too");
            return Err(ScenarioError::rule(format!("{path}.id"), id, rule));
        }
        let place = place(&path, sensor, charger.speed_mps)?;
        if document.coverage.is_some() {
            covering(&path, sensor, &place)?;
        }
        let range = |x| positive(format!("{path}.range_m"), x);
        sensors.push(Sensor {
            id: id.clone(),
            place,
            range_m: optional(sensor.range_m, range)?,
            battery_j: positive(format!("{path}.battery_j"), sensor.battery_j)?,
        });
    }
    Ok(sensors)
}

/// What a coverage constraint asks of each sensor.
fn covering(path: &str, sensor: &SensorDocument, place: &Place) -> Valid<()> {
    if matches!(place, Place::Moving(_)) {
        let rule = format!("coverage cannot be combined with trajectories; {path} has one");
        return Err(ScenarioError::rule("coverage", &"set", rule));
    }
    if sensor.range_m.is_none() {
        let rule = "required where coverage is set";
        return Err(ScenarioError::missing(format!("{path}.range_m"), rule));
    }
    Ok(())
}

fn place(path: &str, sensor: &SensorDocument, charger_mps: f64) -> Valid<Place> {
    match (sensor.position_m, &sensor.trajectory) {
        (Some(xy), None) => Ok(Place::Fixed(point(format!("{path}.position_m"), xy)?)),
        (None, Some(rows)) => {
            trajectory(&format!("{path}.trajectory"), rows, charger_mps).map(Place::Moving)
        }
        (Some(_), Some(rows)) => {
            let rule = "exactly one of position_m and trajectory is allowed";
            Err(ScenarioError::rule(format!("{path}.trajectory"), rows, rule))
        }
        (None, None) => {
            let rule = "exactly one of position_m and trajectory is required";
            Err(ScenarioError::missing(format!("{path}.position_m"), rule))
        }
    }
}

fn trajectory(path: &str, rows: &[[f64; 3]], charger_mps: f64) -> Valid<Trajectory> {
    if rows.is_empty() {
        return Err(ScenarioError::rule(path, &rows, "needs at least one row"));
    }
    let mut waypoints: Vec<Waypoint> = Vec::with_capacity(rows.len());
    for (j, row) in rows.iter().enumerate() {
        let path = format!("{path}[{j}]");
        let [time_s, x, y] = *row;
        if !time_s.is_finite() {
            return Err(ScenarioError::rule(path, row, "must be finite"));
        }
        let next = Waypoint { time_s, position_m: point(&path, [x, y])? };
        if let Some(last) = waypoints.last() {
            let seconds = next.time_s - last.time_s;
            if seconds <= 0.0 {
                return Err(ScenarioError::rule(path, row, "times must rise strictly"));
            }
            if (next.position_m - last.position_m).norm() >= charger_mps * seconds {
                let rule = format!("sensor must be slower than the charger ({charger_mps} m/s)");
                return Err(ScenarioError::rule(path, row, rule));
            }
        }
        waypoints.push(next);
    }
    Ok(Trajectory::new(waypoints))
}

fn requests(document: &Document, charge_level: f64) -> Valid<Vec<Request>> {
    let known = document.sensors.iter().enumerate().map(|(i, sensor)| (sensor.id.as_str(), i));
    let known: HashMap<_, _> = known.collect();
    let mut asked = HashMap::new();
    let mut requests = Vec::with_capacity(document.requests.len());
    for (i, request) in document.requests.iter().enumerate() {
        let path = format!("requests[{i}]");
        let name = format!("{path}.sensor");
        let Some(&sensor) = known.get(request.sensor.as_str()) else {
            return Err(ScenarioError::rule(name, &request.sensor, "must be the id of a sensor"));
        };
        if let Some(first) = asked.insert(sensor, i) {
            let rule = format!("at most one request a sensor; requests[{first}] is the first");
            return Err(ScenarioError::rule(name, &request.sensor, rule));
        }
        let battery_j = document.sensors[sensor].battery_j;
        requests.push(self::request(&path, request, sensor, battery_j, charge_level)?);
    }
    Ok(requests)
}

fn request(
    path: &str,
    document: &RequestDocument,
    sensor: usize,
    battery_j: f64,
    charge_level: f64,
) -> Valid<Request> {
    let number = |name: &str, value: Option<f64>| {
        optional(value, |x| not_negative(format!("{path}.{name}"), x))
    };
    let ready_s = number("ready_s", document.ready_s)?.unwrap_or(0.0);
    let deadline_s = number("deadline_s", document.deadline_s)?;
    if deadline_s.is_some_and(|deadline_s| ready_s > deadline_s) {
        let rule = "must be at or before the deadline";
        return Err(ScenarioError::rule(format!("{path}.ready_s"), &ready_s, rule));
    }
    let drain_w = number("drain_w", document.drain_w)?.unwrap_or(0.0);
    let residual_j = match (number("residual_j", document.residual_j)?, deadline_s) {
        (Some(residual_j), _) => residual_j,
        (None, Some(deadline_s)) if drain_w > 0.0 => battery_j.min(drain_w * deadline_s),
        (None, _) => 0.0,
    };
    if residual_j > battery_j {
        let rule = format!("must be at most the battery ({battery_j} J)");
        return Err(ScenarioError::rule(format!("{path}.residual_j"), &residual_j, rule));
    }
    let needed_j = (charge_level * battery_j - residual_j).max(0.0);
    let reward = number("reward", document.reward)?.unwrap_or(needed_j);
    let required = document.required.unwrap_or(false);
    Ok(Request { sensor, ready_s, deadline_s, drain_w, residual_j, reward, required })
}

fn travel(document: &Document) -> Valid<Option<DistanceMatrix>> {
    let Some(travel) = &document.travel else { return Ok(None) };
    if let Some(i) = document.sensors.iter().position(|sensor| sensor.trajectory.is_some()) {
        let rule = format!("cannot be combined with trajectories; sensors[{i}] has one");
        return Err(ScenarioError::rule("travel.distance_m", &"set", rule));
    }
    let size = document.requests.len() + 2;
    let rows = &travel.distance_m;
    if rows.len() != size {
        let rule = format!("must have {size} rows (start, end, requests), has {}", rows.len());
        return Err(ScenarioError::rule("travel.distance_m", rows, rule));
    }
    let mut distance_m = Vec::with_capacity(size * size);
    for (i, row) in rows.iter().enumerate() {
        if row.len() != size {
            let rule = format!("must have {size} numbers, has {}", row.len());
            return Err(ScenarioError::rule(format!("travel.distance_m[{i}]"), row, rule));
        }
        for (j, &distance) in row.iter().enumerate() {
            if !(distance >= 0.0 && distance.is_finite()) {
                let path = format!("travel.distance_m[{i}][{j}]");
                return Err(ScenarioError::rule(path, &distance, "must be a number >= 0"));
            }
        }
        distance_m.extend_from_slice(row);
    }
    Ok(Some(DistanceMatrix::new(size, distance_m)))
}

fn point(path: impl std::fmt::Display, [x, y]: [f64; 2]) -> Valid<Point> {
    if x.is_finite() && y.is_finite() {
        Ok(Point::new(x, y))
    } else {
        Err(ScenarioError::rule(path, &[x, y], "must be finite"))
    }
}

fn positive(path: impl std::fmt::Display, value: f64) -> Valid<f64> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(ScenarioError::rule(path, &value, "must be > 0"))
    }
}

fn not_negative(path: impl std::fmt::Display, value: f64) -> Valid<f64> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(ScenarioError::rule(path, &value, "must be >= 0"))
    }
}

fn optional(value: Option<f64>, valid: impl Fn(f64) -> Valid<f64>) -> Valid<Option<f64>> {
    value.map(valid).transpose()
}
