//! Networks, requests and departures: each a list and its items.

use std::fmt::Display;
use std::str::FromStr;

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::Uri;

use super::RestState;
use super::problem::Problem;
use super::query::{Params, refusal};
use super::view::{
    Departure, DeparturePage, DepartureState, Network, NetworkPage, Request, RequestPage,
    RequestState,
};
use crate::access::Caller;
use crate::domain::{DepartureId, NetworkId, RequestId};
use crate::store::{DepartureFilter, RequestFilter};

type Id = Result<Path<String>, PathRejection>;

/// An id from a path.
pub(super) fn id<T: FromStr<Err: Display>>(what: &str, text: &str) -> Result<T, Problem> {
    text.parse().map_err(|error| refusal("id", format!("{error}: no id of a {what}")))
}

fn in_path<T: FromStr<Err: Display>>(what: &str, path: Id, uri: &Uri) -> Result<T, Problem> {
    Params::none(uri)?;
    // A path that is no UTF-8 holds no id.
    id(what, &path.map(|Path(text)| text).unwrap_or_default())
}

/// Networks by id, without their specs.
#[utoipa::path(get, path = "/v1/networks", tag = "networks", params(
    ("limit" = Option<u32>, Query, minimum = 1, maximum = 500,
     description = "1 to 500; 50 where it is left out"),
    ("cursor" = Option<String>, Query, max_length = 128,
     description = "`next_cursor` of the page before; opaque"),
), responses(
    (status = 200, description = "A page", body = NetworkPage),
    (status = 400, description = "Bad parameters", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn networks(
    State(state): State<RestState>,
    caller: Caller,
    uri: Uri,
) -> Result<Json<NetworkPage>, Problem> {
    let mut params = Params::of(&uri)?;
    let page = params.page::<NetworkId>();
    params.finish()?;
    Ok(Json(state.reads.networks(caller.networks(), &page).await?.into()))
}

/// The present version of a network, with its spec.
#[utoipa::path(get, path = "/v1/networks/{id}", tag = "networks", params(
    ("id" = String, Path, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "A network's id"),
), responses(
    (status = 200, description = "The network", body = Network),
    (status = 404, description = "There is no such network", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn network(
    State(state): State<RestState>,
    caller: Caller,
    path: Id,
    uri: Uri,
) -> Result<Json<Network>, Problem> {
    let id: NetworkId = in_path("network", path, &uri)?;
    let network = state.reads.network(&id).await?.filter(|_| caller.sees(&id));
    Ok(Json(network.ok_or_else(|| Problem::not_found("network", id))?.into()))
}

/// Requests, newest first.
#[utoipa::path(get, path = "/v1/requests", tag = "requests", params(
    ("network" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this network"),
    ("sensor" = Option<String>, Query, description = "Of this sensor"),
    ("state" = Option<Vec<RequestState>>, Query, description = "In one of these states"),
    ("limit" = Option<u32>, Query, minimum = 1, maximum = 500,
     description = "1 to 500; 50 where it is left out"),
    ("cursor" = Option<String>, Query, max_length = 128,
     description = "`next_cursor` of the page before; opaque"),
), responses(
    (status = 200, description = "A page", body = RequestPage),
    (status = 400, description = "Bad parameters", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn requests(
    State(state): State<RestState>,
    caller: Caller,
    uri: Uri,
) -> Result<Json<RequestPage>, Problem> {
    let mut params = Params::of(&uri)?;
    let filter = RequestFilter {
        within: caller.networks().clone(),
        network_id: params.one("network"),
        states: params.several("state"),
        sensor_id: params.one("sensor"),
    };
    let page = params.page::<RequestId>();
    params.finish()?;
    Ok(Json(state.reads.requests(&filter, &page).await?.into()))
}

/// A request.
#[utoipa::path(get, path = "/v1/requests/{id}", tag = "requests", params(
    ("id" = uuid::Uuid, Path, description = "A request's id"),
), responses(
    (status = 200, description = "The request", body = Request),
    (status = 404, description = "There is no such request", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn request(
    State(state): State<RestState>,
    caller: Caller,
    path: Id,
    uri: Uri,
) -> Result<Json<Request>, Problem> {
    let id: RequestId = in_path("request", path, &uri)?;
    let request = state.reads.request(id).await?;
    let request = request.filter(|request| caller.sees(&request.asked.network_id));
    Ok(Json(request.ok_or_else(|| Problem::not_found("request", id))?.into()))
}

/// Departures, newest first.
#[utoipa::path(get, path = "/v1/departures", tag = "departures", params(
    ("network" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this network"),
    ("charger" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this charger"),
    ("state" = Option<Vec<DepartureState>>, Query, description = "In one of these states"),
    ("limit" = Option<u32>, Query, minimum = 1, maximum = 500,
     description = "1 to 500; 50 where it is left out"),
    ("cursor" = Option<String>, Query, max_length = 128,
     description = "`next_cursor` of the page before; opaque"),
), responses(
    (status = 200, description = "A page", body = DeparturePage),
    (status = 400, description = "Bad parameters", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn departures(
    State(state): State<RestState>,
    caller: Caller,
    uri: Uri,
) -> Result<Json<DeparturePage>, Problem> {
    let mut params = Params::of(&uri)?;
    let filter = DepartureFilter {
        within: caller.networks().clone(),
        network_id: params.one("network"),
        charger_id: params.one("charger"),
        states: params.several("state"),
    };
    let page = params.page::<DepartureId>();
    params.finish()?;
    Ok(Json(state.reads.departures(&filter, &page).await?.into()))
}

/// A departure.
#[utoipa::path(get, path = "/v1/departures/{id}", tag = "departures", params(
    ("id" = uuid::Uuid, Path, description = "A departure's id"),
), responses(
    (status = 200, description = "The departure", body = Departure),
    (status = 404, description = "There is no such departure", body = Problem,
     content_type = "application/problem+json"),
))]
pub(super) async fn departure(
    State(state): State<RestState>,
    caller: Caller,
    path: Id,
    uri: Uri,
) -> Result<Json<Departure>, Problem> {
    let id: DepartureId = in_path("departure", path, &uri)?;
    let departure = state.reads.departure(id).await?;
    let departure = departure.filter(|departure| caller.sees(&departure.announced.network_id));
    Ok(Json(departure.ok_or_else(|| Problem::not_found("departure", id))?.into()))
}
