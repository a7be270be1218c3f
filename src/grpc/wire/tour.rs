//! Tours and the reports of them.

use voltour_solver::plan::Status;

use super::place::{point_to_wire, time_to_wire};
use super::{Fields, Path, Rule};
use crate::domain::{Call, ClientId, NewVisit, Outcome, Refusal, Stop, Tour, TourState, Visit};
use crate::proto;

/// The longest note of a visit.
const NOTE_BYTES: usize = 1024;

/// Reads `TourService.ReportVisit`.
pub fn new_visit(wire: proto::ReportVisitRequest) -> Result<Call<NewVisit>, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let client_id = fields.client_id(&wire.client_id);
    let tour_id = fields.id(at.field("tour_id"), &wire.tour_id);
    let sensor_id = fields.id(at.field("sensor_id"), &wire.sensor_id);
    let outcome = match read_outcome(&mut fields, at.field("outcome"), wire.outcome) {
        Some(None) => fields.refuse(at.field("outcome"), "is missing"),
        outcome => outcome.flatten(),
    };
    let arrived_at = fields.optional_time(at.field("arrived_at"), wire.arrived_at);
    let departed_at = fields.optional_time(at.field("departed_at"), wire.departed_at);
    if let (Some(Some(arrived)), Some(Some(departed))) = (arrived_at, departed_at)
        && departed < arrived
    {
        let rule = "must not be before the arrival";
        fields.add(at.field("departed_at"), format!("{departed} {rule}, {arrived}"));
    }
    let charge = at.field("charge_j");
    let charge_j = fields.optional_number(charge, wire.charge_j, Rule::AtLeastZero);
    let note = fields.text(at.field("note"), wire.note, NOTE_BYTES);
    let call = || {
        let content = NewVisit {
            tour_id: tour_id?,
            sensor_id: sensor_id?,
            outcome: outcome?,
            arrived_at: arrived_at?,
            departed_at: departed_at?,
            charge_j: charge_j?,
            note: note?,
        };
        Some(Call { client_id: client_id?, content })
    };
    let call = call();
    fields.finish(call)
}

fn read_outcome(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<Option<Outcome>> {
    use proto::VisitOutcome as Wire;
    match Wire::try_from(wire) {
        Ok(Wire::Unspecified) => Some(None),
        Ok(Wire::Charged) => Some(Some(Outcome::Charged)),
        Ok(Wire::Skipped) => Some(Some(Outcome::Skipped)),
        Ok(Wire::Failed) => Some(Some(Outcome::Failed)),
        Err(_) => fields.refuse(at, format!("{wire} is no outcome of a visit")),
    }
}

/// Reads a tour as the service answers it.
pub fn tour(wire: proto::Tour) -> Result<Tour, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let id = fields.id(at.field("id"), &wire.id);
    let state = read_state(&mut fields, at.field("state"), wire.state);
    let network_id = fields.id(at.field("network_id"), &wire.network_id);
    let charger_id = fields.id(at.field("charger_id"), &wire.charger_id);
    let departure_id = fields.id(at.field("departure_id"), &wire.departure_id);
    let plan_id = fields.id(at.field("plan_id"), &wire.plan_id);
    let status = read_status(&mut fields, at.field("status"), wire.status);
    let start = fields.required_time(at.field("start"), wire.start);
    let finish = fields.required_time(at.field("finish"), wire.finish);
    let start_m = fields.required_point(at.field("start_m"), wire.start_m);
    let end_m = fields.required_point(at.field("end_m"), wire.end_m);
    let stops = fields.each(at.field("stops"), wire.stops, read_stop);
    let updated_at = fields.required_time(at.field("updated_at"), wire.updated_at);
    let tour = || {
        Some(Tour {
            id: id?,
            state: state?,
            network_id: network_id?,
            charger_id: charger_id?,
            departure_id: departure_id?,
            plan_id: plan_id?,
            revision: wire.revision,
            number: wire.number,
            status: status?,
            start: start?,
            finish: finish?,
            start_m: start_m?,
            end_m: end_m?,
            stops: stops?,
            distance_m: wire.distance_m,
            travel_j: wire.travel_j,
            charge_j: wire.charge_j,
            solver: wire.solver,
            objective: wire.objective,
            bound: wire.bound,
            gap: wire.gap,
            updated_at: updated_at?,
            change: 0,
        })
    };
    let tour = tour();
    fields.finish(tour)
}

fn read_state(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<TourState> {
    use proto::TourState as Wire;
    match Wire::try_from(wire) {
        Ok(Wire::Out) => Some(TourState::Out),
        Ok(Wire::Completed) => Some(TourState::Completed),
        Ok(Wire::Overdue) => Some(TourState::Overdue),
        Ok(Wire::Cancelled) => Some(TourState::Cancelled),
        Ok(Wire::Unspecified) | Err(_) => {
            fields.refuse(at, format!("{wire} is no state of a tour"))
        }
    }
}

fn read_status(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<Status> {
    use proto::PlanStatus as Wire;
    match Wire::try_from(wire) {
        Ok(Wire::Optimal) => Some(Status::Optimal),
        Ok(Wire::Feasible) => Some(Status::Feasible),
        Ok(Wire::BestEffort) => Some(Status::BestEffort),
        Ok(Wire::Infeasible) => Some(Status::Infeasible),
        Ok(Wire::Unspecified) | Err(_) => {
            fields.refuse(at, format!("{wire} is no status of a plan"))
        }
    }
}

fn read_stop(fields: &mut Fields, at: Path<'_>, wire: proto::Stop) -> Option<Stop> {
    let sensor_id = fields.id(at.field("sensor_id"), &wire.sensor_id);
    let request_id = fields.id(at.field("request_id"), &wire.request_id);
    let position_m = fields.required_point(at.field("position_m"), wire.position_m);
    let arrive = fields.required_time(at.field("arrive"), wire.arrive);
    let depart = fields.required_time(at.field("depart"), wire.depart);
    let outcome = read_outcome(fields, at.field("outcome"), wire.outcome);
    Some(Stop {
        sensor_id: sensor_id?,
        request_id: request_id?,
        position_m: position_m?,
        arrive: arrive?,
        depart: depart?,
        charge_j: wire.charge_j,
        outcome: outcome?,
    })
}

/// A tour for the wire.
pub fn tour_to_wire(tour: Tour) -> proto::Tour {
    let state = match tour.state {
        TourState::Out => proto::TourState::Out,
        TourState::Completed => proto::TourState::Completed,
        TourState::Overdue => proto::TourState::Overdue,
        TourState::Cancelled => proto::TourState::Cancelled,
    };
    let status = match tour.status {
        Status::Optimal => proto::PlanStatus::Optimal,
        Status::Feasible => proto::PlanStatus::Feasible,
        Status::BestEffort => proto::PlanStatus::BestEffort,
        Status::Infeasible => proto::PlanStatus::Infeasible,
    };
    proto::Tour {
        id: tour.id.to_string(),
        state: state.into(),
        network_id: tour.network_id.into(),
        charger_id: tour.charger_id.into(),
        departure_id: tour.departure_id.to_string(),
        plan_id: tour.plan_id.to_string(),
        revision: tour.revision,
        number: tour.number,
        status: status.into(),
        start: Some(time_to_wire(tour.start)),
        finish: Some(time_to_wire(tour.finish)),
        start_m: Some(point_to_wire(tour.start_m)),
        end_m: Some(point_to_wire(tour.end_m)),
        stops: tour.stops.into_iter().map(stop_to_wire).collect(),
        distance_m: tour.distance_m,
        travel_j: tour.travel_j,
        charge_j: tour.charge_j,
        solver: tour.solver,
        objective: tour.objective,
        bound: tour.bound,
        gap: tour.gap,
        updated_at: Some(time_to_wire(tour.updated_at)),
    }
}

fn stop_to_wire(stop: Stop) -> proto::Stop {
    proto::Stop {
        sensor_id: stop.sensor_id.into(),
        request_id: stop.request_id.to_string(),
        position_m: Some(point_to_wire(stop.position_m)),
        arrive: Some(time_to_wire(stop.arrive)),
        depart: Some(time_to_wire(stop.depart)),
        charge_j: stop.charge_j,
        outcome: stop.outcome.map_or(proto::VisitOutcome::Unspecified, outcome_to_wire).into(),
    }
}

/// An outcome for the wire.
pub fn outcome_to_wire(outcome: Outcome) -> proto::VisitOutcome {
    match outcome {
        Outcome::Charged => proto::VisitOutcome::Charged,
        Outcome::Skipped => proto::VisitOutcome::Skipped,
        Outcome::Failed => proto::VisitOutcome::Failed,
    }
}

/// A call of `ReportVisit` for the wire.
pub fn new_visit_to_wire(client_id: &ClientId, visit: NewVisit) -> proto::ReportVisitRequest {
    proto::ReportVisitRequest {
        client_id: client_id.as_str().to_owned(),
        tour_id: visit.tour_id.to_string(),
        sensor_id: visit.sensor_id.into(),
        outcome: outcome_to_wire(visit.outcome).into(),
        arrived_at: visit.arrived_at.map(time_to_wire),
        departed_at: visit.departed_at.map(time_to_wire),
        charge_j: visit.charge_j,
        note: visit.note.unwrap_or_default(),
    }
}

/// A stored visit for the wire.
pub fn visit_to_wire(visit: Visit) -> proto::Visit {
    proto::Visit {
        id: visit.id.to_string(),
        reported: Some(new_visit_to_wire(&visit.client_id, visit.reported)),
        received_at: Some(time_to_wire(visit.received_at)),
        served_request_ids: visit.served.iter().map(ToString::to_string).collect(),
    }
}
