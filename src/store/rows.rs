//! From rows to the domain: the columns to select and what is made of them.

use sqlx::sqlite::SqliteRow;
use voltour_solver::gap::gap;

use super::cells::Cells;
use super::{PlanSummary, StoreError};
use crate::domain::{
    Announcement, Departure, Network, NewRequest, NewVisit, Request, RequestState, SensorId, Stop,
    Tour, Visit,
};

type Row<T> = Result<T, StoreError>;

macro_rules! request_columns {
    () => {
        "r.id, r.network_id, r.sensor_id, r.client_id, r.state, r.place, r.deadline_us, r.ready_us, \
         r.residual_j, r.measured_us, r.drain_w, r.reward, r.required, r.withdraw_us, \
         r.departure_id, r.tour_id, r.received_us, r.updated_us, r.change"
    };
}

macro_rules! departure_columns {
    () => {
        "d.id, d.client_id, d.announced, d.state, d.t0_us, d.close_us, d.start_us, \
         d.network_version, d.batch_size, d.reason, d.announced_us, d.updated_us, d.change, \
         (SELECT p.id FROM plans p WHERE p.departure_id = d.id \
          ORDER BY p.revision DESC LIMIT 1) AS plan_id, \
         (SELECT string_agg(t.id, ' ') FROM \
          (SELECT id FROM tours WHERE departure_id = d.id ORDER BY number) t) AS tour_ids"
    };
}

macro_rules! tour_columns {
    () => {
        "t.id, t.state, t.network_id, t.charger_id, t.departure_id, t.plan_id, p.revision, \
         t.number, p.status, t.start_us, t.finish_us, t.start_x_m, t.start_y_m, t.end_x_m, \
         t.end_y_m, t.distance_m, t.travel_j, t.charge_j, p.solver, p.objective, p.bound, \
         t.updated_us, t.change"
    };
}

pub(super) use {departure_columns, request_columns, tour_columns};

pub(super) fn request(row: &SqliteRow) -> Row<Request> {
    let cells = Cells::new("requests", row);
    let state: RequestState = cells.word("state")?;
    let held = matches!(state, RequestState::Batched | RequestState::Planned);
    Ok(Request {
        id: cells.parsed("id")?,
        state,
        client_id: cells.parsed("client_id")?,
        asked: NewRequest {
            network_id: cells.parsed("network_id")?,
            sensor_id: cells.parsed("sensor_id")?,
            place: cells.json_or_none("place")?,
            deadline: cells.time_or_none("deadline_us")?,
            ready: cells.time_or_none("ready_us")?,
            residual_j: cells.get("residual_j")?,
            measured_at: cells.time_or_none("measured_us")?,
            drain_w: cells.get("drain_w")?,
            reward: cells.get("reward")?,
            required: cells.get("required")?,
        },
        received_at: cells.time("received_us")?,
        updated_at: cells.time("updated_us")?,
        departure_id: cells.parsed_or_none("departure_id")?,
        tour_id: cells.parsed_or_none("tour_id")?,
        withdrawal_pending: held && cells.get::<Option<i64>>("withdraw_us")?.is_some(),
        change: cells.number("change")?,
    })
}

pub(super) fn departure(row: &SqliteRow) -> Row<Departure> {
    let cells = Cells::new("departures", row);
    let tours: Option<&str> = cells.get("tour_ids")?;
    let tours = tours.unwrap_or_default().split_whitespace().map(str::parse);
    let announced: Announcement = cells.json("announced")?;
    Ok(Departure {
        id: cells.parsed("id")?,
        state: cells.word("state")?,
        client_id: cells.parsed("client_id")?,
        announced,
        announced_at: cells.time("announced_us")?,
        updated_at: cells.time("updated_us")?,
        t0: cells.time("t0_us")?,
        closes_at: cells.time("close_us")?,
        start: cells.time_or_none("start_us")?,
        network_version: cells
            .get::<Option<i64>>("network_version")?
            .map(|version| version.unsigned_abs()),
        batch_size: cells.count("batch_size")?,
        plan_id: cells.parsed_or_none("plan_id")?,
        tour_ids: tours
            .collect::<Result<_, _>>()
            .map_err(|error| StoreError::row("tours", error))?,
        reason: cells.get("reason")?,
        change: cells.number("change")?,
    })
}

/// A tour without its stops.
pub(super) fn tour(row: &SqliteRow) -> Row<Tour> {
    let cells = Cells::new("tours", row);
    let (status, objective) = (cells.word("status")?, cells.get("objective")?);
    let bound = cells.get("bound")?;
    Ok(Tour {
        id: cells.parsed("id")?,
        state: cells.word("state")?,
        network_id: cells.parsed("network_id")?,
        charger_id: cells.parsed("charger_id")?,
        departure_id: cells.parsed("departure_id")?,
        plan_id: cells.parsed("plan_id")?,
        revision: cells.count("revision")?,
        number: cells.count("number")?,
        status,
        start: cells.time("start_us")?,
        finish: cells.time("finish_us")?,
        start_m: [cells.get("start_x_m")?, cells.get("start_y_m")?],
        end_m: [cells.get("end_x_m")?, cells.get("end_y_m")?],
        stops: Vec::new(),
        distance_m: cells.get("distance_m")?,
        travel_j: cells.get("travel_j")?,
        charge_j: cells.get("charge_j")?,
        solver: cells.get("solver")?,
        objective,
        bound,
        gap: gap(status, objective, bound),
        updated_at: cells.time("updated_us")?,
        change: cells.number("change")?,
    })
}

pub(super) fn stop(row: &SqliteRow) -> Row<Stop> {
    let cells = Cells::new("stops", row);
    Ok(Stop {
        sensor_id: cells.parsed::<SensorId>("sensor_id")?,
        request_id: cells.parsed("request_id")?,
        position_m: [cells.get("x_m")?, cells.get("y_m")?],
        arrive: cells.time("arrive_us")?,
        depart: cells.time("depart_us")?,
        charge_j: cells.get("charge_j")?,
        outcome: cells.word_or_none("outcome")?,
    })
}

pub(super) fn visit(row: &SqliteRow) -> Row<Visit> {
    let cells = Cells::new("visits", row);
    Ok(Visit {
        id: cells.parsed("id")?,
        client_id: cells.parsed("client_id")?,
        reported: NewVisit {
            tour_id: cells.parsed("tour_id")?,
            sensor_id: cells.parsed("sensor_id")?,
            outcome: cells.word("outcome")?,
            arrived_at: cells.time_or_none("arrived_us")?,
            departed_at: cells.time_or_none("departed_us")?,
            charge_j: cells.get("charge_j")?,
            note: cells.get("note")?,
        },
        received_at: cells.time("received_us")?,
        served: cells.json("served")?,
    })
}

/// A network without its spec.
pub(super) fn network(row: &SqliteRow) -> Row<Network> {
    let cells = Cells::new("networks", row);
    Ok(Network {
        id: cells.parsed("id")?,
        version: cells.number("version")?,
        created_at: cells.time("created_us")?,
        updated_at: cells.time("updated_us")?,
        sensor_count: cells.count("sensor_count")?,
        spec: None,
    })
}

pub(super) fn plan(row: &SqliteRow) -> Row<PlanSummary> {
    let cells = Cells::new("plans", row);
    let (status, objective) = (cells.word("status")?, cells.get("objective")?);
    let bound = cells.get("bound")?;
    Ok(PlanSummary {
        id: cells.parsed("id")?,
        departure_id: cells.parsed("departure_id")?,
        revision: cells.count("revision")?,
        network_id: cells.parsed("network_id")?,
        charger_id: cells.parsed("charger_id")?,
        status,
        solver: cells.get("solver")?,
        objective,
        bound,
        gap: gap(status, objective, bound),
        distance_m: cells.get("distance_m")?,
        stops: cells.count("stop_count")?,
        unserved: cells.count("unserved_count")?,
        start: cells.time("start_us")?,
        finish: cells.time("finish_us")?,
        created_at: cells.time("created_us")?,
    })
}
