//! What the operator reads: lines of text, or the domain's JSON.

use std::fmt::{Display, Write as _};

use jiff::Timestamp;
use serde::Serialize;
use voltour_solver::gap::percent;

use crate::cli::{Failure, say};
use crate::domain::{Departure, Network, Outcome, Place, Request, Tour};

/// Prints one thing, as text or as JSON.
pub fn item<T: Serialize>(
    json: bool,
    item: &T,
    text: impl FnOnce(&T) -> String,
) -> Result<(), Failure> {
    if json {
        let line = serde_json::to_string(item)
            .map_err(|error| Failure::other(format!("not printable as JSON: {error}")))?;
        say(line);
    } else {
        say(text(item));
    }
    Ok(())
}

/// The name of a state, as the domain spells it.
pub fn word<T: Serialize>(value: &T) -> String {
    let json = serde_json::to_value(value).unwrap_or_default();
    json.as_str().unwrap_or_default().to_owned()
}

/// Free text, with everything escaped that a terminal might act upon.
pub fn free(text: impl Display) -> String {
    text.to_string().escape_debug().to_string()
}

/// A time, to the second.
pub fn time(time: Timestamp) -> String {
    format!("{time:.0}")
}

/// A network in a line.
pub fn network_line(network: &Network) -> String {
    let Network { id, version, sensor_count, updated_at, .. } = network;
    format!("{id}  version {version}  {sensor_count} sensors  updated {}", time(*updated_at))
}

/// A network with its spec.
pub fn network(network: &Network) -> String {
    let mut text = network_line(network);
    let Some(spec) = &network.spec else { return text };
    let _ = write!(text, "\n  objective {}", word(&spec.objective));
    if let Some(coverage) = &spec.coverage {
        let _ = write!(text, ", every point covered by {}", coverage.k);
    }
    for kind in &spec.charger_types {
        let (name, speed, power) = (&kind.name, kind.speed_mps, kind.transfer_w);
        let _ = write!(text, "\n  charger type {name}  {speed} m/s  {power} W");
    }
    for sensor in &spec.sensors {
        let id = free(&sensor.id);
        let _ = write!(text, "\n  sensor {id}  {} J", sensor.battery_j);
        match &sensor.place {
            Place::PositionM([x, y]) => {
                let _ = write!(text, "  at {x},{y}");
            }
            Place::Trajectory(points) => {
                let _ = write!(text, "  moving, {} waypoints", points.len());
            }
        }
    }
    text
}

/// A request in a line.
pub fn request(request: &Request) -> String {
    let asked = &request.asked;
    let deadline = asked.deadline.map(|at| format!("  deadline {}", time(at)));
    format!(
        "{}  {:10}  {}/{}{}{}",
        request.id,
        word(&request.state),
        asked.network_id,
        free(&asked.sensor_id),
        deadline.unwrap_or_default(),
        if asked.required { "  required" } else { "" },
    )
}

/// A departure in a line.
pub fn departure(departure: &Departure) -> String {
    let announced = &departure.announced;
    let mut text = format!(
        "{}  {:10}  {}/{}  leaves {}  batch closes {}",
        departure.id,
        word(&departure.state),
        announced.network_id,
        announced.charger_id,
        time(departure.start.unwrap_or(departure.t0)),
        time(departure.closes_at),
    );
    if let Some(reason) = &departure.reason {
        let _ = write!(text, "  ({})", free(reason));
    }
    text
}

/// A tour with its stops.
pub fn tour(tour: &Tour) -> String {
    let mut text = format!(
        "tour {} of charger {} in {}\n  {}, plan {} ({}, by {}){}\n  leaves {}, back {}; {:.1} m, {:.0} J to sensors, {:.0} J to travel",
        tour.id,
        tour.charger_id,
        tour.network_id,
        word(&tour.state),
        tour.plan_id,
        word(&tour.status),
        free(&tour.solver),
        proof(tour),
        time(tour.start),
        time(tour.finish),
        tour.distance_m,
        tour.charge_j,
        tour.travel_j,
    );
    if tour.stops.is_empty() {
        text.push_str("\n  no stops");
    }
    for (index, stop) in tour.stops.iter().enumerate() {
        let [x, y] = stop.position_m;
        let _ = write!(
            text,
            "\n  {:>3}. {}  at {x:.1},{y:.1}  {} to {}  {:.0} J",
            index + 1,
            free(&stop.sensor_id),
            time(stop.arrive),
            time(stop.depart),
            stop.charge_j,
        );
        if let Some(outcome) = stop.outcome {
            let _ = write!(text, "  {}", outcome_word(outcome));
        }
    }
    text
}

/// What is proven of a tour's objective; nothing where nothing is.
fn proof(tour: &Tour) -> String {
    let Some(bound) = tour.bound else { return String::new() };
    let gap = tour.gap.map(|gap| format!(", gap {}", percent(gap))).unwrap_or_default();
    format!("\n  objective {:.3}, proven bound {bound:.3}{gap}", tour.objective)
}

fn outcome_word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Charged => "charged",
        Outcome::Skipped => "skipped",
        Outcome::Failed => "failed",
    }
}
