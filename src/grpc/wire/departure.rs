//! Departures.

use super::place::{point_to_wire, time_to_wire};
use super::{Fields, Path, Rule};
use crate::domain::{Announcement, Call, ChargerId, ClientId, Departure, DepartureState, Refusal};
use crate::proto;

/// Reads `DepartureService.Announce`.
pub fn announcement(wire: proto::AnnounceRequest) -> Result<Call<Announcement>, Refusal> {
    let mut fields = Fields::default();
    let client_id = fields.client_id(&wire.client_id);
    let content = read(&mut fields, Path::ROOT, wire);
    fields.finish(client_id.zip(content).map(|(client_id, content)| Call { client_id, content }))
}

fn read(fields: &mut Fields, at: Path<'_>, wire: proto::AnnounceRequest) -> Option<Announcement> {
    let network_id = fields.id(at.field("network_id"), &wire.network_id);
    let charger_id = fields.id(at.field("charger_id"), &wire.charger_id);
    let charger_type =
        fields.optional_id::<ChargerId>(at.field("charger_type"), &wire.charger_type);
    let t0 = fields.optional_time(at.field("t0"), wire.t0);
    let start_m = fields.optional_point(at.field("start_m"), wire.start_m);
    let end_m = fields.optional_point(at.field("end_m"), wire.end_m);
    let capacity_j =
        fields.optional_number(at.field("capacity_j"), wire.capacity_j, Rule::AtLeastZero);
    let timespan_s =
        fields.optional_number(at.field("timespan_s"), wire.timespan_s, Rule::AtLeastZero);
    Some(Announcement {
        network_id: network_id?,
        charger_id: charger_id?,
        charger_type: charger_type?.map(String::from),
        t0: t0?,
        start_m: start_m?,
        end_m: end_m?,
        capacity_j: capacity_j?,
        timespan_s: timespan_s?,
    })
}

/// Reads a state, as filters and answers name it.
pub fn departure_state(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<DepartureState> {
    use proto::DepartureState as Wire;
    match Wire::try_from(wire) {
        Ok(Wire::Announced) => Some(DepartureState::Announced),
        Ok(Wire::Closed) => Some(DepartureState::Closed),
        Ok(Wire::Planned) => Some(DepartureState::Planned),
        Ok(Wire::Completed) => Some(DepartureState::Completed),
        Ok(Wire::Overdue) => Some(DepartureState::Overdue),
        Ok(Wire::Cancelled) => Some(DepartureState::Cancelled),
        Ok(Wire::Missed) => Some(DepartureState::Missed),
        Ok(Wire::Unspecified) | Err(_) => {
            fields.refuse(at, format!("{wire} is no state of a departure"))
        }
    }
}

/// Reads a departure as the service answers it.
pub fn departure(wire: proto::Departure) -> Result<Departure, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let id = fields.id(at.field("id"), &wire.id);
    let state = departure_state(&mut fields, at.field("state"), wire.state);
    let announced = fields.present(at.field("announced"), wire.announced).unwrap_or_default();
    let client_id = fields.id(at.field("announced"), &announced.client_id);
    let announced = read(&mut fields, at.field("announced"), announced);
    let announced_at = fields.required_time(at.field("announced_at"), wire.announced_at);
    let updated_at = fields.required_time(at.field("updated_at"), wire.updated_at);
    let t0 = fields.required_time(at.field("t0"), wire.t0);
    let closes_at = fields.required_time(at.field("closes_at"), wire.closes_at);
    let start = fields.optional_time(at.field("start"), wire.start);
    let plan_id = fields.optional_id(at.field("plan_id"), &wire.plan_id);
    let tours = fields.each(at.field("tour_ids"), wire.tour_ids, |f, at, id| f.id(at, &id));
    let departure = || {
        Some(Departure {
            id: id?,
            state: state?,
            client_id: client_id?,
            announced: announced?,
            announced_at: announced_at?,
            updated_at: updated_at?,
            t0: t0?,
            closes_at: closes_at?,
            start: start?,
            network_version: None,
            batch_size: wire.batch_size,
            plan_id: plan_id?,
            tour_ids: tours?,
            reason: Some(wire.reason).filter(|reason| !reason.is_empty()),
            change: 0,
        })
    };
    let departure = departure();
    fields.finish(departure)
}

/// A call of `Announce` for the wire.
pub fn announcement_to_wire(client_id: &ClientId, asked: Announcement) -> proto::AnnounceRequest {
    proto::AnnounceRequest {
        client_id: client_id.as_str().to_owned(),
        network_id: asked.network_id.into(),
        charger_id: asked.charger_id.into(),
        charger_type: asked.charger_type.unwrap_or_default(),
        t0: asked.t0.map(time_to_wire),
        start_m: asked.start_m.map(point_to_wire),
        end_m: asked.end_m.map(point_to_wire),
        capacity_j: asked.capacity_j,
        timespan_s: asked.timespan_s,
    }
}

/// A departure for the wire.
pub fn departure_to_wire(departure: Departure) -> proto::Departure {
    use proto::DepartureState as Wire;
    let state = match departure.state {
        DepartureState::Announced => Wire::Announced,
        DepartureState::Closed => Wire::Closed,
        DepartureState::Planned => Wire::Planned,
        DepartureState::Completed => Wire::Completed,
        DepartureState::Overdue => Wire::Overdue,
        DepartureState::Cancelled => Wire::Cancelled,
        DepartureState::Missed => Wire::Missed,
    };
    proto::Departure {
        id: departure.id.to_string(),
        state: state.into(),
        announced: Some(announcement_to_wire(&departure.client_id, departure.announced)),
        announced_at: Some(time_to_wire(departure.announced_at)),
        updated_at: Some(time_to_wire(departure.updated_at)),
        t0: Some(time_to_wire(departure.t0)),
        closes_at: Some(time_to_wire(departure.closes_at)),
        start: departure.start.map(time_to_wire),
        batch_size: departure.batch_size,
        plan_id: departure.plan_id.map(|id| id.to_string()).unwrap_or_default(),
        tour_ids: departure.tour_ids.iter().map(ToString::to_string).collect(),
        reason: departure.reason.unwrap_or_default(),
    }
}
