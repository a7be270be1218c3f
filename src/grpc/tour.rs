//! `TourService`.

use std::pin::Pin;

use futures_util::Stream;
use tonic::{Request, Response, Status};

use super::guard::{caller, guarded, revoked};
use super::status::read_failed;
use super::watch::{Followed, follow};
use super::wire::{self, Fields, Path};
use super::{Edge, deadline, status};
use crate::access::Caller;
use crate::domain::{self, Call, ChargerId, NetworkId, Refusal, TourId};
use crate::proto::tour_service_server::TourService;
use crate::proto::{
    CompleteRequest, GetNextRequest, ReportVisitRequest, Tour, TourChange, Visit, WatchToursRequest,
};
use crate::store::{Reads, StoreError};

#[tonic::async_trait]
impl TourService for Edge {
    type WatchStream = Pin<Box<dyn Stream<Item = Result<TourChange, Status>> + Send>>;

    async fn get_next(&self, call: Request<GetNextRequest>) -> Result<Response<Tour>, Status> {
        let caller = caller(call.extensions())?;
        let wait = deadline::wait(call.metadata(), self.limits.longest_wait);
        let call = call.into_inner();
        let mut fields = Fields::default();
        let at = Path::ROOT;
        let network = fields.id::<NetworkId>(at.field("network_id"), &call.network_id);
        let charger = fields.id::<ChargerId>(at.field("charger_id"), &call.charger_id);
        let departure = fields.optional_id(at.field("departure_id"), &call.departure_id);
        let ids = network.zip(charger).zip(departure);
        let ((network, charger), departure) = fields.finish(ids)?;
        caller.network(&network)?;
        caller.drives(&charger)?;
        let _waits = self.wait_permit()?;
        let planned = self.handle.next_tour(&network, &charger, departure);
        let tour = tokio::select! {
            planned = tokio::time::timeout(wait, planned) => planned.map_err(|_| {
                let waited = wait.as_secs_f64();
                let text = format!("no tour of charger {charger} was planned within {waited} s");
                Refusal::DeadlineExceeded(text)
            })??,
            () = self.stop.cancelled() => return Err(status::stopping()),
            () = self.gate.revoked(&caller) => return Err(revoked().into()),
        };
        Ok(Response::new(wire::tour_to_wire(tour)))
    }

    async fn watch(
        &self,
        call: Request<WatchToursRequest>,
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
        let wanted =
            move |tour: &domain::Tour| charger.as_ref().is_none_or(|id| *id == tour.charger_id);
        let changes = follow(self, network, wanted).await?;
        Ok(Response::new(guarded(&self.gate, &caller, changes)))
    }

    async fn report_visit(
        &self,
        call: Request<ReportVisitRequest>,
    ) -> Result<Response<Visit>, Status> {
        let caller = caller(call.extensions())?;
        let call = wire::new_visit(call.into_inner())?;
        self.may_report(&caller, call.content.tour_id).await?;
        let visit = self.handle.report_visit(call).await?;
        Ok(Response::new(wire::visit_to_wire(visit)))
    }

    async fn complete(&self, call: Request<CompleteRequest>) -> Result<Response<Tour>, Status> {
        let caller = caller(call.extensions())?;
        let call = call.into_inner();
        let mut fields = Fields::default();
        let client_id = fields.client_id(&call.client_id);
        let tour_id = fields.id::<TourId>(Path::ROOT.field("tour_id"), &call.tour_id);
        let call = client_id.zip(tour_id);
        let (client_id, content) = fields.finish(call)?;
        self.may_report(&caller, content).await?;
        let tour = self.handle.complete(Call { client_id, content }).await?;
        Ok(Response::new(wire::tour_to_wire(tour)))
    }
}

impl Edge {
    /// Whether the tour is one that the caller may report about. Whose it is never changes.
    async fn may_report(&self, caller: &Caller, id: TourId) -> Result<(), Refusal> {
        if !caller.is_restricted() {
            return Ok(());
        }
        let tour = self.handle.reads().tour(id).await.map_err(read_failed)?;
        let seen = tour.filter(|tour| caller.sees(&tour.network_id));
        let tour = seen.ok_or(Refusal::NotFound { what: "tour", id: id.to_string() })?;
        caller.drives(&tour.charger_id)
    }
}

impl Followed for domain::Tour {
    type Message = TourChange;

    async fn live(reads: &Reads, network: &NetworkId) -> Result<(Vec<Self>, u64), StoreError> {
        reads.live_tours(network).await
    }

    async fn since(
        reads: &Reads,
        network: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Self>, StoreError> {
        reads.tours_since(network, change, limit).await
    }

    fn change(&self) -> u64 {
        self.change
    }

    fn message(self, initial: bool) -> TourChange {
        let change = self.change;
        TourChange { tour: Some(wire::tour_to_wire(self)), initial, change }
    }
}
