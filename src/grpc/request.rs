//! `RequestService`.

use std::pin::Pin;

use futures_util::Stream;
use tonic::{Request, Response, Status, Streaming};

use super::guard::{caller, guarded};
use super::status::read_failed;
use super::watch::{Followed, follow};
use super::wire::{self, Fields, Path};
use super::{Edge, page_token, submit_stream};
use crate::domain::{self, Call, NetworkId, Refusal, RequestId};
use crate::proto::request_service_server::RequestService;
use crate::proto::{
    Acknowledgement, ChargingRequest, GetRequestRequest, ListRequestsRequest, ListRequestsResponse,
    RequestChange, SubmitRequest, WatchRequestsRequest, WithdrawRequest,
};
use crate::scheduler::Withdraw;
use crate::store::{Reads, RequestFilter, StoreError};

#[tonic::async_trait]
impl RequestService for Edge {
    type SubmitStreamStream = Pin<Box<dyn Stream<Item = Result<Acknowledgement, Status>> + Send>>;
    type WatchStream = Pin<Box<dyn Stream<Item = Result<RequestChange, Status>> + Send>>;

    async fn submit(
        &self,
        call: Request<SubmitRequest>,
    ) -> Result<Response<ChargingRequest>, Status> {
        let caller = caller(call.extensions())?;
        let submitted = async {
            let call = wire::new_request(call.into_inner())?;
            caller.network(&call.content.network_id)?;
            self.handle.submit(call).await
        };
        let request = submitted.await.inspect_err(|refusal| self.calls.refused(refusal))?;
        Ok(Response::new(wire::request_to_wire(request)))
    }

    async fn submit_stream(
        &self,
        call: Request<Streaming<SubmitRequest>>,
    ) -> Result<Response<Self::SubmitStreamStream>, Status> {
        let caller = caller(call.extensions())?;
        let permit = self.stream_permit()?;
        let (edge, items) = (self.clone(), call.into_inner());
        let answers = submit_stream::acknowledge(edge, caller.clone(), items, permit);
        Ok(Response::new(guarded(&self.gate, &caller, answers)))
    }

    async fn withdraw(
        &self,
        call: Request<WithdrawRequest>,
    ) -> Result<Response<ChargingRequest>, Status> {
        let caller = caller(call.extensions())?;
        let call = withdraw(call.into_inner())?;
        caller.network(&call.content.network_id)?;
        let request = self.handle.withdraw(call).await?;
        Ok(Response::new(wire::request_to_wire(request)))
    }

    async fn get(
        &self,
        call: Request<GetRequestRequest>,
    ) -> Result<Response<ChargingRequest>, Status> {
        let caller = caller(call.extensions())?;
        let mut fields = Fields::default();
        let id = fields.id(Path::ROOT.field("request_id"), &call.into_inner().request_id);
        let id: RequestId = fields.finish(id)?;
        let request = self.handle.reads().request(id).await.map_err(read_failed)?;
        let request = request.filter(|request| caller.sees(&request.asked.network_id));
        let request = request.ok_or(Refusal::NotFound { what: "request", id: id.to_string() })?;
        Ok(Response::new(wire::request_to_wire(request)))
    }

    async fn list(
        &self,
        call: Request<ListRequestsRequest>,
    ) -> Result<Response<ListRequestsResponse>, Status> {
        let caller = caller(call.extensions())?;
        let call = call.into_inner();
        let mut fields = Fields::default();
        let at = Path::ROOT;
        let page = page_token::page::<RequestId>(&mut fields, call.page_size, &call.page_token);
        let network_id = fields.optional_id(at.field("network_id"), &call.network_id);
        let sensor_id = fields.optional_id(at.field("sensor_id"), &call.sensor_id);
        let states = fields.each(at.field("states"), call.states, wire::request_state);
        let filter =
            network_id.zip(sensor_id).zip(states).map(|((network_id, sensor_id), states)| {
                let within = caller.networks().clone();
                RequestFilter { within, network_id, states, sensor_id }
            });
        let (filter, page) = fields.finish(filter.zip(page))?;
        let listed = self.handle.reads().requests(&filter, &page).await.map_err(read_failed)?;
        Ok(Response::new(ListRequestsResponse {
            requests: listed.items.into_iter().map(wire::request_to_wire).collect(),
            next_page_token: page_token::token(listed.next),
        }))
    }

    async fn watch(
        &self,
        call: Request<WatchRequestsRequest>,
    ) -> Result<Response<Self::WatchStream>, Status> {
        let caller = caller(call.extensions())?;
        let mut fields = Fields::default();
        let id = fields.id(Path::ROOT.field("network_id"), &call.into_inner().network_id);
        let id = fields.finish(id)?;
        caller.network(&id)?;
        let changes = follow(self, id, |_: &domain::Request| true).await?;
        Ok(Response::new(guarded(&self.gate, &caller, changes)))
    }
}

fn withdraw(wire: WithdrawRequest) -> Result<Call<Withdraw>, Refusal> {
    let mut fields = Fields::default();
    let client_id = fields.client_id(&wire.client_id);
    let network_id = fields.id(Path::ROOT.field("network_id"), &wire.network_id);
    let request_id = fields.id(Path::ROOT.field("request_id"), &wire.request_id);
    let content = network_id
        .zip(request_id)
        .map(|(network_id, request_id)| Withdraw { network_id, request_id });
    fields.finish(client_id.zip(content).map(|(client_id, content)| Call { client_id, content }))
}

impl Followed for domain::Request {
    type Message = RequestChange;

    async fn live(reads: &Reads, network: &NetworkId) -> Result<(Vec<Self>, u64), StoreError> {
        reads.live_requests(network).await
    }

    async fn since(
        reads: &Reads,
        network: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Self>, StoreError> {
        reads.requests_since(network, change, limit).await
    }

    fn change(&self) -> u64 {
        self.change
    }

    fn message(self, initial: bool) -> RequestChange {
        let change = self.change;
        RequestChange { request: Some(wire::request_to_wire(self)), initial, change }
    }
}
