//! `DepartureService`.

use std::pin::Pin;

use futures_util::Stream;
use tonic::{Request, Response, Status};

use super::guard::{caller, guarded};
use super::status::read_failed;
use super::watch::{Followed, follow};
use super::wire::{self, Fields, Path};
use super::{Edge, page_token};
use crate::access::Caller;
use crate::domain::{self, Call, ChargerId, DepartureId, NetworkId, Refusal};
use crate::proto::departure_service_server::DepartureService;
use crate::proto::{
    AnnounceRequest, CancelDepartureRequest, Departure, DepartureChange, GetDepartureRequest,
    ListDeparturesRequest, ListDeparturesResponse, WatchDeparturesRequest,
};
use crate::scheduler::CancelDeparture;
use crate::store::{DepartureFilter, Reads, StoreError};

/// The longest reason of a cancellation.
const REASON_BYTES: usize = 256;

#[tonic::async_trait]
impl DepartureService for Edge {
    type WatchStream = Pin<Box<dyn Stream<Item = Result<DepartureChange, Status>> + Send>>;

    async fn announce(
        &self,
        call: Request<AnnounceRequest>,
    ) -> Result<Response<Departure>, Status> {
        let caller = caller(call.extensions())?;
        let call = wire::announcement(call.into_inner())?;
        caller.network(&call.content.network_id)?;
        caller.drives(&call.content.charger_id)?;
        let departure = self.handle.announce(call).await?;
        note(departure.id);
        Ok(Response::new(wire::departure_to_wire(departure)))
    }

    async fn cancel(
        &self,
        call: Request<CancelDepartureRequest>,
    ) -> Result<Response<Departure>, Status> {
        let caller = caller(call.extensions())?;
        let call = cancel(call.into_inner())?;
        note(call.content.departure_id);
        if caller.is_restricted() {
            self.departure_of(&caller, call.content.departure_id).await?;
        }
        let departure = self.handle.cancel(call).await?;
        Ok(Response::new(wire::departure_to_wire(departure)))
    }

    async fn get(&self, call: Request<GetDepartureRequest>) -> Result<Response<Departure>, Status> {
        let caller = caller(call.extensions())?;
        let mut fields = Fields::default();
        let id = fields.id(Path::ROOT.field("departure_id"), &call.into_inner().departure_id);
        let departure = self.departure_of(&caller, fields.finish(id)?).await?;
        Ok(Response::new(wire::departure_to_wire(departure)))
    }

    async fn list(
        &self,
        call: Request<ListDeparturesRequest>,
    ) -> Result<Response<ListDeparturesResponse>, Status> {
        let caller = caller(call.extensions())?;
        let call = call.into_inner();
        let mut fields = Fields::default();
        let at = Path::ROOT;
        let page = page_token::page::<DepartureId>(&mut fields, call.page_size, &call.page_token);
        let network_id = fields.optional_id(at.field("network_id"), &call.network_id);
        let charger_id = fields.optional_id(at.field("charger_id"), &call.charger_id);
        let states = fields.each(at.field("states"), call.states, wire::departure_state);
        let filter =
            network_id.zip(charger_id).zip(states).map(|((network_id, charger_id), states)| {
                let within = caller.networks().clone();
                DepartureFilter { within, network_id, charger_id, states }
            });
        let (mut filter, page) = fields.finish(filter.zip(page))?;
        filter.charger_id = caller.among(filter.charger_id)?;
        let listed = self.handle.reads().departures(&filter, &page).await.map_err(read_failed)?;
        Ok(Response::new(ListDeparturesResponse {
            departures: listed.items.into_iter().map(wire::departure_to_wire).collect(),
            next_page_token: page_token::token(listed.next),
        }))
    }

    async fn watch(
        &self,
        call: Request<WatchDeparturesRequest>,
    ) -> Result<Response<Self::WatchStream>, Status> {
        let caller = caller(call.extensions())?;
        let call = call.into_inner();
        let mut fields = Fields::default();
        let network = fields.id(Path::ROOT.field("network_id"), &call.network_id);
        let charger = fields.optional_id(Path::ROOT.field("charger_id"), &call.charger_id);
        let (network, charger): (NetworkId, Option<ChargerId>) =
            fields.finish(network.zip(charger))?;
        caller.network(&network)?;
        let charger = caller.among(charger)?;
        let wanted = move |departure: &domain::Departure| {
            charger.as_ref().is_none_or(|id| *id == departure.announced.charger_id)
        };
        let changes = follow(self, network, wanted).await?;
        Ok(Response::new(guarded(&self.gate, &caller, changes)))
    }
}

impl Edge {
    /// A departure that the caller may ask about.
    async fn departure_of(
        &self,
        caller: &Caller,
        id: DepartureId,
    ) -> Result<domain::Departure, Refusal> {
        let departure = self.handle.reads().departure(id).await.map_err(read_failed)?;
        let seen = departure.filter(|departure| caller.sees(&departure.announced.network_id));
        let departure = seen.ok_or(Refusal::NotFound { what: "departure", id: id.to_string() })?;
        caller.drives(&departure.announced.charger_id)?;
        Ok(departure)
    }
}

/// So that a departure's way can be followed by its id, from its announcement on.
fn note(id: DepartureId) {
    tracing::Span::current().record("departure", tracing::field::display(id));
}

fn cancel(wire: CancelDepartureRequest) -> Result<Call<CancelDeparture>, Refusal> {
    let mut fields = Fields::default();
    let client_id = fields.client_id(&wire.client_id);
    let departure_id = fields.id(Path::ROOT.field("departure_id"), &wire.departure_id);
    let reason = fields.text(Path::ROOT.field("reason"), wire.reason, REASON_BYTES);
    let content = departure_id.zip(reason).map(|(departure_id, reason)| CancelDeparture {
        departure_id,
        reason: reason.unwrap_or_default(),
    });
    fields.finish(client_id.zip(content).map(|(client_id, content)| Call { client_id, content }))
}

impl Followed for domain::Departure {
    type Message = DepartureChange;

    async fn live(reads: &Reads, network: &NetworkId) -> Result<(Vec<Self>, u64), StoreError> {
        reads.live_departures(network).await
    }

    async fn since(
        reads: &Reads,
        network: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Self>, StoreError> {
        reads.departures_since(network, change, limit).await
    }

    fn change(&self) -> u64 {
        self.change
    }

    fn message(self, initial: bool) -> DepartureChange {
        let change = self.change;
        DepartureChange { departure: Some(wire::departure_to_wire(self)), initial, change }
    }
}
