//! A network in the middle of its life, and for every method and route a call about it.

use prost::Message;
use tonic_health::pb::HealthCheckRequest;
use tonic_reflection::pb::v1::ServerReflectionRequest;
use tonic_reflection::pb::v1::server_reflection_request::MessageRequest;
use voltour::proto::{
    AnnounceRequest, CancelDepartureRequest, CompleteRequest, GetDepartureRequest,
    GetNetworkRequest, GetNextRequest, GetRequestRequest, ListDeparturesRequest,
    ListNetworksRequest, ListRequestsRequest, PutNetworkRequest, ReportVisitRequest, SubmitRequest,
    UpdateTrajectoryRequest, VisitOutcome, WatchDeparturesRequest, WatchRequestsRequest,
    WatchToursRequest, WithdrawRequest,
};

use crate::app::TestApp;
use crate::explanations::explanation;
use crate::field::{FIELD, line};

/// The ids of what there is in a network, or of what there is nowhere; all as long as each other.
#[derive(Clone, Debug)]
pub struct World {
    pub network: String,
    pub charger: String,
    pub request: String,
    pub departure: String,
    pub tour: String,
    pub plan: String,
}

impl World {
    /// A network with a request that waits, and a charger on its tour. The service must need no token yet.
    pub async fn new(app: &TestApp) -> Self {
        app.put(line(2)).await;
        app.ask("s1").await;
        let tour = app.drive("truck-A").await;
        explanation(app, &tour).await;
        let waits = app.ask("s2").await;
        Self {
            network: FIELD.into(),
            charger: "truck-A".into(),
            request: waits.id,
            departure: tour.departure_id,
            tour: tour.id,
            plan: tour.plan_id,
        }
    }

    /// Nothing of it exists.
    pub fn phantom() -> Self {
        let id = |n: u8| format!("01890a5d-ac96-774b-bcce-b302099a80{n:02}");
        Self {
            network: "ghost".into(),
            charger: "truck-Z".into(),
            request: id(1),
            departure: id(2),
            tour: id(3),
            plan: id(4),
        }
    }

    fn ids(&self) -> [&str; 6] {
        [&self.network, &self.charger, &self.request, &self.departure, &self.tour, &self.plan]
    }

    /// Whether any of it is named.
    pub fn is_in(&self, bytes: &[u8]) -> bool {
        let holds = |id: &str| bytes.windows(id.len()).any(|part| part == id.as_bytes());
        self.ids().into_iter().any(holds)
    }

    /// An answer about this world as if it were about that one.
    pub fn told_of(&self, other: &Self, answer: &str) -> String {
        let pairs = self.ids().into_iter().zip(other.ids());
        pairs.fold(answer.to_owned(), |text, (own, theirs)| text.replace(own, theirs))
    }

    /// A call of a method about this world; a new method needs one here.
    pub fn message(&self, method: &str) -> Vec<u8> {
        let (service, name) = method.rsplit_once('/').expect("a path");
        let client_id = format!("walk-{name}");
        let network_id = self.network.clone();
        let charger_id = self.charger.clone();
        let departure_id = self.departure.clone();
        let (request_id, tour_id) = (self.request.clone(), self.tour.clone());
        let sensor_id = "s2".to_owned();
        let submit = SubmitRequest {
            client_id: client_id.clone(),
            network_id: network_id.clone(),
            sensor_id: sensor_id.clone(),
            ..SubmitRequest::default()
        };
        match (service.trim_start_matches("/voltour.v1."), name) {
            ("NetworkService", "Put") => {
                let spec = Some(line(2));
                PutNetworkRequest { client_id, network_id, spec, ..Default::default() }
                    .encode_to_vec()
            }
            ("NetworkService", "Get") => GetNetworkRequest { network_id }.encode_to_vec(),
            ("NetworkService", "List") => ListNetworksRequest::default().encode_to_vec(),
            ("NetworkService", "UpdateTrajectory") => {
                UpdateTrajectoryRequest { client_id, network_id, trajectories: vec![] }
                    .encode_to_vec()
            }
            ("RequestService", "Submit" | "SubmitStream") => submit.encode_to_vec(),
            ("RequestService", "Withdraw") => {
                WithdrawRequest { client_id, network_id, request_id }.encode_to_vec()
            }
            ("RequestService", "Get") => GetRequestRequest { request_id }.encode_to_vec(),
            ("RequestService", "List") => ListRequestsRequest::default().encode_to_vec(),
            ("RequestService", "Watch") => WatchRequestsRequest { network_id }.encode_to_vec(),
            ("DepartureService", "Announce") => {
                AnnounceRequest { client_id, network_id, charger_id, ..Default::default() }
                    .encode_to_vec()
            }
            ("DepartureService", "Cancel") => {
                CancelDepartureRequest { client_id, departure_id, reason: "walk".into() }
                    .encode_to_vec()
            }
            ("DepartureService", "Get") => GetDepartureRequest { departure_id }.encode_to_vec(),
            ("DepartureService", "List") => ListDeparturesRequest::default().encode_to_vec(),
            ("DepartureService", "Watch") => {
                WatchDeparturesRequest { network_id, charger_id: String::new() }.encode_to_vec()
            }
            ("TourService", "GetNext") => {
                GetNextRequest { network_id, charger_id, departure_id }.encode_to_vec()
            }
            ("TourService", "Watch") => {
                WatchToursRequest { network_id, charger_id: String::new() }.encode_to_vec()
            }
            ("TourService", "ReportVisit") => {
                let outcome = VisitOutcome::Skipped as i32;
                ReportVisitRequest { client_id, tour_id, sensor_id, outcome, ..Default::default() }
                    .encode_to_vec()
            }
            ("TourService", "Complete") => CompleteRequest { client_id, tour_id }.encode_to_vec(),
            ("/grpc.health.v1.Health", _) => HealthCheckRequest::default().encode_to_vec(),
            (_, "ServerReflectionInfo") => {
                let message_request = Some(MessageRequest::ListServices(String::new()));
                ServerReflectionRequest { host: String::new(), message_request }.encode_to_vec()
            }
            _ => panic!("{method} needs a message here"),
        }
    }

    /// Paths of a route about this world.
    pub fn paths(&self, route: &str) -> Vec<String> {
        let id = |id: &str| vec![route.replace("{id}", id)];
        match route.split('/').nth(2) {
            None => vec![route.to_owned()],
            Some("networks") if route.contains("{id}") => id(&self.network),
            Some("requests") if route.contains("{id}") => id(&self.request),
            Some("departures") if route.contains("{id}") => id(&self.departure),
            Some("plans") if route.ends_with("{id}") => {
                let forms = ["", ".svg", ".geojson", ".geojson?origin=11.58,48.14"];
                forms.map(|form| format!("/v1/plans/{}{form}", self.plan)).into()
            }
            Some("plans") if route.contains("{id}") => id(&self.plan),
            // Of a list: all of it, and what belongs to this network.
            Some("requests" | "departures" | "plans" | "plans.csv") => {
                vec![route.to_owned(), format!("{route}?network={}", self.network)]
            }
            Some("networks" | "log-filter" | "") => vec![route.to_owned()],
            Some("{file}") => vec![route.replace("{file}", "index.html")],
            Some(_) => panic!("{route} needs its paths here"),
        }
    }
}
