//! The one table: every gRPC method and every REST route, and who may call it. What has no entry is
//! called by nobody.
//!
//! Which networks, and which charger, a caller may name is no matter of the table: the edges ask the
//! [`Caller`](super::Caller) for every one that a call names or finds.

use crate::domain::Role;

/// Who may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Who {
    /// Anybody, without a token: what tells whether the service lives.
    Anybody,
    /// Whoever has a token: what is the same for all, and tells of no network.
    Holders,
    /// Holders of these roles.
    Roles(&'static [Role]),
    /// Holders of these roles whose token is for all networks: what tells of all of them.
    Everywhere(&'static [Role]),
}

use Role::{Admin, BaseStation, Charger, Operator};
use Who::{Anybody, Everywhere, Holders, Roles};

const STATIONS: Who = Roles(&[BaseStation, Operator, Admin]);
const CHARGERS: Who = Roles(&[Charger, Operator, Admin]);
const ALL: Who = Roles(&[BaseStation, Charger, Operator, Admin]);
const OPERATORS: Who = Roles(&[Operator, Admin]);

/// gRPC methods, by their path.
pub const GRPC: &[(&str, Who)] = &[
    ("/voltour.v1.NetworkService/Put", STATIONS),
    ("/voltour.v1.NetworkService/Get", STATIONS),
    ("/voltour.v1.NetworkService/List", STATIONS),
    ("/voltour.v1.NetworkService/UpdateTrajectory", STATIONS),
    ("/voltour.v1.RequestService/Submit", STATIONS),
    ("/voltour.v1.RequestService/SubmitStream", STATIONS),
    ("/voltour.v1.RequestService/Withdraw", STATIONS),
    ("/voltour.v1.RequestService/Get", STATIONS),
    ("/voltour.v1.RequestService/List", STATIONS),
    ("/voltour.v1.RequestService/Watch", STATIONS),
    ("/voltour.v1.DepartureService/Announce", CHARGERS),
    ("/voltour.v1.DepartureService/Cancel", CHARGERS),
    ("/voltour.v1.DepartureService/Get", ALL),
    ("/voltour.v1.DepartureService/List", ALL),
    ("/voltour.v1.DepartureService/Watch", ALL),
    ("/voltour.v1.TourService/GetNext", CHARGERS),
    ("/voltour.v1.TourService/Watch", CHARGERS),
    ("/voltour.v1.TourService/ReportVisit", CHARGERS),
    ("/voltour.v1.TourService/Complete", CHARGERS),
    ("/grpc.health.v1.Health/Check", Anybody),
    ("/grpc.health.v1.Health/Watch", Anybody),
    ("/grpc.reflection.v1.ServerReflection/ServerReflectionInfo", Holders),
    ("/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", Holders),
];

/// REST routes, by their template.
pub const REST: &[(&str, Who)] = &[
    ("/v1/networks", OPERATORS),
    ("/v1/networks/{id}", OPERATORS),
    ("/v1/requests", OPERATORS),
    ("/v1/requests/{id}", OPERATORS),
    ("/v1/departures", OPERATORS),
    ("/v1/departures/{id}", OPERATORS),
    ("/v1/plans", OPERATORS),
    ("/v1/plans.csv", OPERATORS),
    ("/v1/plans/{id}", OPERATORS),
    ("/v1/plans/{id}/scenario", OPERATORS),
    ("/v1/plans/{id}/explanation", OPERATORS),
    ("/v1/log-filter", Everywhere(&[Admin])),
    ("/openapi.json", Holders),
    ("/docs", Holders),
    ("/docs/", Holders),
    ("/docs/{file}", Holders),
    // It counts over all networks.
    ("/metrics", Everywhere(&[Operator, Admin])),
    ("/healthz", Anybody),
    ("/readyz", Anybody),
];

/// Who may call a gRPC method; none where it has no entry.
pub fn grpc(path: &str) -> Option<Who> {
    find(GRPC, path)
}

/// Who may call a REST route; none where it has no entry.
pub fn rest(route: &str) -> Option<Who> {
    find(REST, route)
}

fn find(table: &[(&str, Who)], name: &str) -> Option<Who> {
    table.iter().find(|(entry, _)| *entry == name).map(|(_, who)| *who)
}
