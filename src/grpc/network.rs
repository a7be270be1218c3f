//! `NetworkService`.

use tonic::{Request, Response, Status};

use super::guard::caller;
use super::status::read_failed;
use super::wire::{self, Fields, Path};
use super::{Edge, page_token};
use crate::domain::{NetworkId, Refusal};
use crate::proto::network_service_server::NetworkService;
use crate::proto::{
    GetNetworkRequest, ListNetworksRequest, ListNetworksResponse, Network, PutNetworkRequest,
    UpdateTrajectoryRequest, UpdateTrajectoryResponse,
};

#[tonic::async_trait]
impl NetworkService for Edge {
    async fn put(&self, call: Request<PutNetworkRequest>) -> Result<Response<Network>, Status> {
        let caller = caller(call.extensions())?;
        let call = wire::put_network(call.into_inner())?;
        caller.put(&call.content.network_id)?;
        let network = self.handle.put_network(call).await?;
        Ok(Response::new(wire::network_to_wire(network)))
    }

    async fn get(&self, call: Request<GetNetworkRequest>) -> Result<Response<Network>, Status> {
        let caller = caller(call.extensions())?;
        let mut fields = Fields::default();
        let id = fields.id(Path::ROOT.field("network_id"), &call.into_inner().network_id);
        let id: NetworkId = fields.finish(id)?;
        caller.network(&id)?;
        let network = self.handle.reads().network(&id).await.map_err(read_failed)?;
        let network =
            network.ok_or(Refusal::NotFound { what: "network", id: id.as_str().to_owned() })?;
        Ok(Response::new(wire::network_to_wire(network)))
    }

    async fn list(
        &self,
        call: Request<ListNetworksRequest>,
    ) -> Result<Response<ListNetworksResponse>, Status> {
        let caller = caller(call.extensions())?;
        let call = call.into_inner();
        let mut fields = Fields::default();
        let page = page_token::page::<NetworkId>(&mut fields, call.page_size, &call.page_token);
        let page = fields.finish(page)?;
        let listed = self.handle.reads().networks(caller.networks(), &page).await;
        let listed = listed.map_err(read_failed)?;
        Ok(Response::new(ListNetworksResponse {
            networks: listed.items.into_iter().map(wire::network_to_wire).collect(),
            next_page_token: page_token::token(listed.next),
        }))
    }

    async fn update_trajectory(
        &self,
        call: Request<UpdateTrajectoryRequest>,
    ) -> Result<Response<UpdateTrajectoryResponse>, Status> {
        let caller = caller(call.extensions())?;
        let call = wire::trajectories(call.into_inner())?;
        caller.network(&call.content.network_id)?;
        let updated = self.handle.update_trajectories(call).await?;
        Ok(Response::new(UpdateTrajectoryResponse { updated }))
    }
}
