//! `TourService`.

use std::pin::Pin;

use futures_util::Stream;
use tonic::{Request, Response, Status};

use super::watch::{Followed, follow};
use super::wire::{self, Fields, Path};
use super::{Edge, deadline, status};
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
        let wait = deadline::wait(call.metadata(), self.limits.longest_wait);
        let call = call.into_inner();
        let mut fields = Fields::default();
        let at = Path::ROOT;
        let network = fields.id::<NetworkId>(at.field("network_id"), &call.network_id);
        let charger = fields.id::<ChargerId>(at.field("charger_id"), &call.charger_id);
        let departure = fields.optional_id(at.field("departure_id"), &call.departure_id);
        let ids = network.zip(charger).zip(departure);
        let ((network, charger), departure) = fields.finish(ids)?;
        let planned = self.handle.next_tour(&network, &charger, departure);
        let tour = tokio::select! {
            planned = tokio::time::timeout(wait, planned) => planned.map_err(|_| {
                let waited = wait.as_secs_f64();
                let text = format!("no tour of charger {charger} was planned within {waited} s");
                Refusal::DeadlineExceeded(text)
            })??,
            () = self.stop.cancelled() => return Err(status::stopping()),
        };
        Ok(Response::new(wire::tour_to_wire(tour)))
    }

    async fn watch(
        &self,
        call: Request<WatchToursRequest>,
    ) -> Result<Response<Self::WatchStream>, Status> {
        let call = call.into_inner();
        let mut fields = Fields::default();
        let network = fields.id(Path::ROOT.field("network_id"), &call.network_id);
        let charger = fields.optional_id(Path::ROOT.field("charger_id"), &call.charger_id);
        let (network, charger): (NetworkId, Option<ChargerId>) =
            fields.finish(network.zip(charger))?;
        let wanted =
            move |tour: &domain::Tour| charger.as_ref().is_none_or(|id| *id == tour.charger_id);
        Ok(Response::new(Box::pin(follow(self, network, wanted).await?)))
    }

    async fn report_visit(
        &self,
        call: Request<ReportVisitRequest>,
    ) -> Result<Response<Visit>, Status> {
        let call = wire::new_visit(call.into_inner())?;
        let visit = self.handle.report_visit(call).await?;
        Ok(Response::new(wire::visit_to_wire(visit)))
    }

    async fn complete(&self, call: Request<CompleteRequest>) -> Result<Response<Tour>, Status> {
        let call = call.into_inner();
        let mut fields = Fields::default();
        let client_id = fields.client_id(&call.client_id);
        let tour_id = fields.id::<TourId>(Path::ROOT.field("tour_id"), &call.tour_id);
        let call = client_id.zip(tour_id);
        let (client_id, content) = fields.finish(call)?;
        let tour = self.handle.complete(Call { client_id, content }).await?;
        Ok(Response::new(wire::tour_to_wire(tour)))
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
