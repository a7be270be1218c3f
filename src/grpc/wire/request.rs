//! Charging requests.

use super::place::{place_to_wire, time_to_wire};
use super::{Fields, Path, Rule};
use crate::domain::{Call, ClientId, NewRequest, Refusal, Request, RequestState};
use crate::proto;

/// Reads `RequestService.Submit`, and each item of `SubmitStream`.
pub fn new_request(wire: proto::SubmitRequest) -> Result<Call<NewRequest>, Refusal> {
    let mut fields = Fields::default();
    let client_id = fields.client_id(&wire.client_id);
    let content = read(&mut fields, Path::ROOT, wire);
    fields.finish(client_id.zip(content).map(|(client_id, content)| Call { client_id, content }))
}

fn read(fields: &mut Fields, at: Path<'_>, wire: proto::SubmitRequest) -> Option<NewRequest> {
    let network_id = fields.id(at.field("network_id"), &wire.network_id);
    let sensor_id = fields.id(at.field("sensor_id"), &wire.sensor_id);
    let place = match wire.place {
        None => Some(None),
        Some(place) => fields.place(at.field("place"), place).map(Some),
    };
    let deadline = fields.optional_time(at.field("deadline"), wire.deadline);
    let ready = fields.optional_time(at.field("ready"), wire.ready);
    let measured_at = fields.optional_time(at.field("measured_at"), wire.measured_at);
    let mut number = |name, value| fields.optional_number(at.field(name), value, Rule::AtLeastZero);
    let residual_j = number("residual_j", wire.residual_j);
    let drain_w = number("drain_w", wire.drain_w);
    let reward = number("reward", wire.reward);
    if let (Some(Some(ready)), Some(Some(deadline))) = (ready, deadline)
        && ready > deadline
    {
        fields
            .add(at.field("ready"), format!("{ready} must not be after the deadline, {deadline}"));
    }
    Some(NewRequest {
        network_id: network_id?,
        sensor_id: sensor_id?,
        place: place?,
        deadline: deadline?,
        ready: ready?,
        residual_j: residual_j?,
        measured_at: measured_at?,
        drain_w: drain_w?,
        reward: reward?,
        required: wire.required,
    })
}

/// Reads a state, as filters and answers name it.
pub fn request_state(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<RequestState> {
    use proto::RequestState as Wire;
    match Wire::try_from(wire) {
        Ok(Wire::Open) => Some(RequestState::Open),
        Ok(Wire::Batched) => Some(RequestState::Batched),
        Ok(Wire::Planned) => Some(RequestState::Planned),
        Ok(Wire::Served) => Some(RequestState::Served),
        Ok(Wire::Expired) => Some(RequestState::Expired),
        Ok(Wire::Withdrawn) => Some(RequestState::Withdrawn),
        Ok(Wire::Superseded) => Some(RequestState::Superseded),
        Ok(Wire::Unspecified) | Err(_) => {
            fields.refuse(at, format!("{wire} is no state of a request"))
        }
    }
}

/// A state for the wire.
pub fn request_state_to_wire(state: RequestState) -> proto::RequestState {
    use proto::RequestState as Wire;
    match state {
        RequestState::Open => Wire::Open,
        RequestState::Batched => Wire::Batched,
        RequestState::Planned => Wire::Planned,
        RequestState::Served => Wire::Served,
        RequestState::Expired => Wire::Expired,
        RequestState::Withdrawn => Wire::Withdrawn,
        RequestState::Superseded => Wire::Superseded,
    }
}

/// Reads a request as the service answers it.
pub fn request(wire: proto::ChargingRequest) -> Result<Request, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let id = fields.id(at.field("id"), &wire.id);
    let state = request_state(&mut fields, at.field("state"), wire.state);
    let submitted = fields.present(at.field("submitted"), wire.submitted).unwrap_or_default();
    let client_id = fields.id(at.field("submitted"), &submitted.client_id);
    let asked = read(&mut fields, at.field("submitted"), submitted);
    let received_at = fields.required_time(at.field("received_at"), wire.received_at);
    let updated_at = fields.required_time(at.field("updated_at"), wire.updated_at);
    let departure_id = fields.optional_id(at.field("departure_id"), &wire.departure_id);
    let tour_id = fields.optional_id(at.field("tour_id"), &wire.tour_id);
    let request = || {
        Some(Request {
            id: id?,
            state: state?,
            client_id: client_id?,
            asked: asked?,
            received_at: received_at?,
            updated_at: updated_at?,
            departure_id: departure_id?,
            tour_id: tour_id?,
            withdrawal_pending: wire.withdrawal_pending,
            change: 0,
        })
    };
    let request = request();
    fields.finish(request)
}

/// A call of `Submit` for the wire.
pub fn new_request_to_wire(client_id: &ClientId, asked: NewRequest) -> proto::SubmitRequest {
    proto::SubmitRequest {
        client_id: client_id.as_str().to_owned(),
        place: asked.place.as_ref().map(place_to_wire),
        network_id: asked.network_id.into(),
        sensor_id: asked.sensor_id.into(),
        deadline: asked.deadline.map(time_to_wire),
        ready: asked.ready.map(time_to_wire),
        residual_j: asked.residual_j,
        measured_at: asked.measured_at.map(time_to_wire),
        drain_w: asked.drain_w,
        reward: asked.reward,
        required: asked.required,
    }
}

/// A request for the wire.
pub fn request_to_wire(request: Request) -> proto::ChargingRequest {
    proto::ChargingRequest {
        id: request.id.to_string(),
        state: request_state_to_wire(request.state).into(),
        submitted: Some(new_request_to_wire(&request.client_id, request.asked)),
        received_at: Some(time_to_wire(request.received_at)),
        updated_at: Some(time_to_wire(request.updated_at)),
        departure_id: request.departure_id.map(|id| id.to_string()).unwrap_or_default(),
        tour_id: request.tour_id.map(|id| id.to_string()).unwrap_or_default(),
        withdrawal_pending: request.withdrawal_pending,
    }
}
