//! The routes over a real database.

use std::pin::pin;
use std::time::Duration;

use axum::body::Body;
use axum::http::header::{
    ACCEPT_ENCODING, AUTHORIZATION, CACHE_CONTROL, CONTENT_TYPE, ETAG, IF_NONE_MATCH,
};
use axum::http::{HeaderMap, Request, StatusCode};
use futures_util::StreamExt;
use serde_json::{Value, json};
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;
use voltour_solver::plan::Status;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::plan_from_order;

use super::{Guard, RestState, router};
use crate::access::{Gate, Secret};
use crate::clock::plus;
use crate::metrics::Metrics;
use crate::store::fixture::Bench;
use crate::store::{Listed, NewPlan, PlanFilter, StorePlan, pack};
use crate::telemetry::LogFilter;

/// A service's database and its REST edge.
struct Edge {
    bench: Bench,
    state: RestState,
    shutdown: CancellationToken,
}

struct Answer {
    status: StatusCode,
    headers: HeaderMap,
    body: Vec<u8>,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }

    /// Of a list: the ids of its items.
    fn ids(&self) -> Vec<String> {
        let page = self.json();
        let items = page["items"].as_array().unwrap().iter();
        items.map(|item| item["id"].as_str().unwrap().to_owned()).collect()
    }
}

impl Edge {
    async fn new() -> Self {
        let bench = Bench::new().await;
        let shutdown = CancellationToken::new();
        let state = RestState::new(
            bench.store.reads.clone(),
            Metrics::default(),
            LogFilter::default(),
            shutdown.clone(),
        );
        Self { bench, state, shutdown }
    }

    async fn ask(&self, request: Request<Body>) -> Answer {
        let gate = Gate::open(self.bench.store.reads.clone(), None).await.unwrap();
        let guard = Guard::new(gate, false, &[], 64);
        let response = router(self.state.clone(), guard).oneshot(request).await.unwrap();
        let (parts, body) = response.into_parts();
        let body = axum::body::to_bytes(body, 1 << 22).await.unwrap().to_vec();
        Answer { status: parts.status, headers: parts.headers, body }
    }

    async fn get(&self, path: &str) -> Answer {
        self.ask(Request::get(path).body(Body::empty()).unwrap()).await
    }

    async fn good(&self, path: &str) -> Answer {
        let answer = self.get(path).await;
        assert_eq!(answer.status, 200, "{path}: {}", String::from_utf8_lossy(&answer.body));
        answer
    }

    /// A problem of that status, which names these fields.
    async fn refused(&self, path: &str, status: u16, fields: &[&str]) {
        let answer = self.get(path).await;
        assert_eq!(answer.status, status, "{path}");
        assert_eq!(answer.headers[CONTENT_TYPE], "application/problem+json", "{path}");
        let problem = answer.json();
        assert_eq!(problem["status"], status);
        let errors = problem["errors"].as_array().cloned().unwrap_or_default();
        let named: Vec<_> = errors.iter().map(|e| e["field"].as_str().unwrap()).collect();
        assert_eq!(named, fields, "{path}");
    }

    /// Stores a plan with an empty tour; its id.
    async fn plan(&self) -> String {
        let scenario = json!({
            "format": "voltour/scenario/1", "name": "<one>", "objective": "max_count",
            "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
            "sensors": [], "requests": []
        });
        let scenario = scenario.to_string();
        let plan =
            plan_from_order(&Scenario::from_json(scenario.as_bytes()).unwrap(), &[], "greedy");
        let envelope = json!({"plan": plan, "provenance": {"seed": 1}}).to_string();
        let departure_id = self.bench.announce("truck").await;
        let batch = self.bench.closed(departure_id).await;
        let plan = NewPlan {
            status: Status::Feasible,
            solver: "greedy".into(),
            objective: 0.0,
            bound: None,
            distance_m: 0.0,
            travel_j: 0.0,
            charge_j: 0.0,
            start_m: [0.0; 2],
            end_m: [0.0; 2],
            finish: plus(batch.start, Duration::from_secs(1)),
            stops: Vec::new(),
            unserved: 0,
            envelope: pack(envelope.as_bytes()).unwrap(),
            scenario: pack(scenario.as_bytes()).unwrap(),
        };
        let store = StorePlan { departure_id, start: batch.start, plan };
        self.bench.store.writer.call(store).await.unwrap();
        let departure = self.bench.store.reads.departure(departure_id).await.unwrap().unwrap();
        departure.plan_id.unwrap().to_string()
    }
}

#[tokio::test]
async fn a_network_is_shown_with_its_spec() {
    let edge = Edge::new().await;
    let network = edge.good("/v1/networks/net").await.json();
    assert_eq!(network["spec"]["sensors"][1]["position_m"], json!([10.0, 0.0]));
    assert_eq!(network["spec"]["objective"], "max_count");
    let list = edge.good("/v1/networks").await.json();
    assert_eq!((&list["items"][0]["id"], &list["next_cursor"]), (&json!("net"), &Value::Null));
    assert!(list["items"][0].get("spec").is_none());
    edge.refused("/v1/networks/none", 404, &[]).await;
    edge.refused("/v1/networks/a%20b", 400, &["id"]).await;
}

#[tokio::test]
async fn requests_are_listed_page_by_page() {
    let edge = Edge::new().await;
    let mut made = Vec::new();
    for sensor in ["s0", "s1", "s2"] {
        made.push(edge.bench.submit(sensor).await.id.to_string());
    }
    made.reverse();
    let first = edge.good("/v1/requests?network=net&state=open&limit=2").await;
    assert_eq!(first.ids(), made[..2]);
    let cursor = first.json()["next_cursor"].as_str().unwrap().to_owned();
    let next = format!("/v1/requests?network=net&state=open&limit=2&cursor={cursor}");
    let last = edge.good(&next).await;
    assert_eq!((last.ids().as_slice(), &last.json()["next_cursor"]), (&made[2..], &Value::Null));
    assert_eq!(edge.good("/v1/requests?sensor=s1").await.ids(), made[1..2]);
    assert!(edge.good("/v1/requests?state=served&state=expired").await.ids().is_empty());
    let one = edge.good(&format!("/v1/requests/{}", made[0])).await.json();
    assert_eq!((&one["sensor_id"], &one["state"]), (&json!("s2"), &json!("open")));
    edge.refused(&format!("/v1/departures/{}", made[0]), 404, &[]).await;
}

#[tokio::test]
async fn a_plan_is_shown_in_every_form_and_never_changes() {
    let edge = Edge::new().await;
    let id = edge.plan().await;
    let list = edge.good("/v1/plans?charger=truck&status=feasible&solver=greedy").await;
    assert_eq!(list.ids(), [id.as_str()]);
    assert!(edge.good("/v1/plans?from=2026-02-01T00:00:00Z").await.ids().is_empty());
    for (end, kind, start) in [
        ("", "application/json", "{\"plan\":"),
        ("/scenario", "application/json", "{"),
        (".svg", "image/svg+xml", "<svg"),
        (".geojson", "application/geo+json", "{\"type\":\"FeatureCollection\""),
        (".geojson?origin=11.5,48", "application/geo+json", "{\"type\":\"FeatureCollection\""),
    ] {
        let path = format!("/v1/plans/{id}{end}");
        let answer = edge.good(&path).await;
        assert_eq!(answer.headers[CONTENT_TYPE], kind);
        assert!(answer.headers[CACHE_CONTROL].to_str().unwrap().contains("immutable"));
        assert!(answer.body.starts_with(start.as_bytes()), "{end}");
        let tag = &answer.headers[ETAG];
        let again = Request::get(&path).header(IF_NONE_MATCH, tag).body(Body::empty()).unwrap();
        let again = edge.ask(again).await;
        assert_eq!((again.status.as_u16(), again.body.len()), (304, 0));
        assert_eq!(&again.headers[ETAG], tag);
    }
    let departure = edge.good("/v1/departures?state=planned").await.json();
    assert_eq!(departure["items"][0]["plan_id"], json!(id));
}

#[tokio::test]
async fn what_is_not_there_is_a_problem() {
    let edge = Edge::new().await;
    let stranger = "01890a5d-ac96-774b-bcce-b302099a8057";
    for end in ["", ".svg", ".geojson", "/scenario", "/explanation"] {
        edge.refused(&format!("/v1/plans/{stranger}{end}"), 404, &[]).await;
        edge.refused(&format!("/v1/plans/nothing{end}"), 400, &["id"]).await;
    }
    edge.refused("/v1/plans/%ff", 400, &["id"]).await;
    edge.refused(&format!("/v1/plans/{stranger}.svg?origin=1,2"), 400, &["origin"]).await;
    edge.refused(&format!("/v1/plans/{stranger}.geojson?origin=1"), 400, &["origin"]).await;
    edge.refused("/v1/plans.csv?limit=1&from=now", 400, &["from", "limit"]).await;
    edge.refused("/docs/nothing.js", 404, &[]).await;
    edge.refused("/v1/tours", 404, &[]).await;
    edge.refused("/v1/plans?until=never&colour=red", 400, &["until", "colour"]).await;
    edge.refused(&format!("/v1/plans/{stranger}?x=1"), 400, &["x"]).await;
    edge.refused("/v1/departures?limit=501", 400, &["limit"]).await;
}

#[tokio::test]
async fn readiness_ends_with_the_shutdown() {
    let edge = Edge::new().await;
    assert_eq!(edge.good("/readyz").await.json(), json!({"status": "ok"}));
    edge.shutdown.cancel();
    edge.refused("/readyz", 503, &[]).await;
    edge.good("/healthz").await;
    assert!(edge.good("/openapi.json").await.json()["paths"].is_object());
}

#[tokio::test]
async fn the_history_is_a_table_too() {
    let edge = Edge::new().await;
    let empty = edge.good("/v1/plans.csv").await;
    assert_eq!(empty.headers[CONTENT_TYPE], "text/csv; charset=utf-8; header=present");
    assert_eq!(empty.body.iter().filter(|&&byte| byte == b'\n').count(), 1, "a header");
    let id = edge.plan().await;
    let table = edge.good("/v1/plans.csv?network=net&charger=truck").await.body;
    let table = String::from_utf8(table).unwrap();
    assert_eq!(table.lines().count(), 2);
    assert!(table.lines().nth(1).unwrap().starts_with(&id), "{table}");
    assert_eq!(edge.good("/v1/plans.csv?solver=random").await.body, empty.body);
    let packed = Request::get("/v1/plans.csv").header(ACCEPT_ENCODING, "gzip").body(Body::empty());
    assert!(edge.ask(packed.unwrap()).await.body.starts_with(&[0x1f, 0x8b]));
}

#[tokio::test]
async fn a_long_table_goes_on_page_by_page_and_breaks_off_with_the_service() {
    let edge = Edge::new().await;
    let id = edge.plan().await;
    let table = || {
        let first = Listed { items: Vec::new(), next: Some("ffffffff".to_owned()) };
        super::export::table(edge.state.clone(), PlanFilter::default(), first)
    };
    let pieces: Vec<_> = table().collect().await;
    let texts: Vec<_> =
        pieces.into_iter().map(|piece| String::from_utf8(piece.unwrap()).unwrap()).collect();
    assert!(texts[0].starts_with("id,departure_id,") && texts[1].starts_with(&id), "{texts:?}");
    assert_eq!(texts.len(), 2);
    edge.shutdown.cancel();
    let pieces: Vec<_> = table().collect().await;
    assert_eq!(pieces.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false]);
}

#[tokio::test]
async fn the_document_has_a_page_and_the_page_asks_nobody_else() {
    let edge = Edge::new().await;
    let moved = edge.get("/docs").await;
    assert_eq!(
        (moved.status.as_u16(), moved.headers["location"].as_bytes()),
        (308, &b"/docs/"[..])
    );
    let page = edge.good("/docs/").await;
    assert!(page.headers[CONTENT_TYPE].to_str().unwrap().starts_with("text/html"));
    let text = String::from_utf8(page.body).unwrap();
    let quoted = text.split('"').skip(1).step_by(2);
    let files: Vec<_> =
        quoted.filter(|name| name.ends_with(".js") || name.ends_with(".css")).collect();
    assert!(files.len() >= 3 && !text.contains("//"), "{text}");
    for file in files {
        let answer = edge.good(&format!("/docs/{}", file.trim_start_matches("./"))).await;
        let policy = answer.headers["content-security-policy"].to_str().unwrap();
        assert!(policy.contains("default-src 'none'") && !policy.contains("http"), "{policy}");
    }
    let start = edge.good("/docs/swagger-initializer.js").await.body;
    let start = String::from_utf8(start).unwrap();
    assert!(
        start.contains("\"/openapi.json\"") && start.contains("\"validatorUrl\": \"none\""),
        "{start}"
    );
}

#[tokio::test]
async fn calls_beyond_the_limit_are_told_to_try_again() {
    let edge = Edge::new().await;
    let gate = Gate::open(edge.bench.store.reads.clone(), None).await.unwrap();
    let routes = router(edge.state.clone(), Guard::new(gate, false, &[], 1));
    let ask = |path: &str| routes.clone().oneshot(Request::get(path).body(Body::empty()).unwrap());
    // The first waits for its picture, and holds its place meanwhile.
    let pictures = edge.state.pictures.clone().acquire_many_owned(2).await.unwrap();
    let plan = edge.plan().await;
    let mut first = pin!(ask(&format!("/v1/plans/{plan}.svg")));
    let early = tokio::time::timeout(Duration::ZERO, &mut first).await;
    assert!(early.is_err(), "{early:?}");
    let refused = ask("/v1/networks").await.unwrap();
    assert_eq!(refused.status(), StatusCode::TOO_MANY_REQUESTS);
    assert_eq!(refused.headers()["retry-after"], "1");
    assert_eq!(refused.headers()[CONTENT_TYPE], "application/problem+json");
    assert_eq!(ask("/healthz").await.unwrap().status(), 200);
    assert_eq!(ask("/metrics").await.unwrap().status(), 200, "the service is busy, and not down");
    drop(pictures);
    assert_eq!(first.await.unwrap().status(), 200);
    assert_eq!(ask("/v1/networks").await.unwrap().status(), 200);
}

#[tokio::test]
async fn without_room_no_token_is_looked_up() {
    let edge = Edge::new().await;
    let bootstrap = Secret::random().unwrap();
    let gate = Gate::open(edge.bench.store.reads.clone(), Some(&bootstrap)).await.unwrap();
    let unknown = Secret::random().unwrap();
    for (most, status) in [(0, StatusCode::TOO_MANY_REQUESTS), (1, StatusCode::UNAUTHORIZED)] {
        let routes = router(edge.state.clone(), Guard::new(gate.clone(), false, &[], most));
        let bearer = format!("Bearer {}", unknown.reveal());
        let call = Request::get("/v1/networks").header(AUTHORIZATION, bearer);
        let answer = routes.oneshot(call.body(Body::empty()).unwrap()).await.unwrap();
        assert_eq!(answer.status(), status);
    }
}
