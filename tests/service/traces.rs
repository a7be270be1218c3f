//! Spans, as an OpenTelemetry collector gets them; and that nobody waits for one.

use std::collections::HashSet;
use std::sync::{Arc, Mutex};

use opentelemetry_proto::tonic::collector::trace::v1::trace_service_server::{
    TraceService, TraceServiceServer,
};
use opentelemetry_proto::tonic::collector::trace::v1::{
    ExportTraceServiceRequest, ExportTraceServiceResponse,
};
use opentelemetry_proto::tonic::common::v1::any_value::Value;
use opentelemetry_proto::tonic::trace::v1::Span;
use tokio::net::TcpListener;
use tokio_stream::wrappers::TcpListenerStream;
use tonic::{Request, Response, Status};

use crate::app::{PATIENCE, Settings, TestApp};
use crate::field::{line, request};

/// A collector that keeps what it gets.
#[derive(Clone, Default)]
struct Collector(Arc<Mutex<Vec<Span>>>);

#[tonic::async_trait]
impl TraceService for Collector {
    async fn export(
        &self,
        call: Request<ExportTraceServiceRequest>,
    ) -> Result<Response<ExportTraceServiceResponse>, Status> {
        let resources = call.into_inner().resource_spans.into_iter();
        let scopes = resources.flat_map(|resource| resource.scope_spans);
        self.0.lock().unwrap().extend(scopes.flat_map(|scope| scope.spans));
        Ok(Response::new(ExportTraceServiceResponse::default()))
    }
}

impl Collector {
    /// The collector and its address.
    async fn start() -> (Self, String) {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = format!("http://{}", listener.local_addr().unwrap());
        let collector = Self::default();
        let server = tonic::transport::Server::builder()
            .add_service(TraceServiceServer::new(collector.clone()))
            .serve_with_incoming(TcpListenerStream::new(listener));
        tokio::spawn(server);
        (collector, address)
    }
}

fn configured(endpoint: &str) -> Settings {
    let more = format!("[telemetry]\notlp_endpoint = {endpoint:?}\n");
    Settings { more, ..Settings::default() }
}

fn attribute<'a>(span: &'a Span, key: &str) -> Option<&'a str> {
    let found = span.attributes.iter().find(|attribute| attribute.key == key)?;
    match found.value.as_ref()?.value.as_ref()? {
        Value::StringValue(text) => Some(text),
        _ => None,
    }
}

/// All that is below a span.
fn below<'a>(spans: &'a [Span], root: &Span) -> Vec<&'a Span> {
    let mut ids = HashSet::from([root.span_id.clone()]);
    let mut found: Vec<&Span> = Vec::new();
    loop {
        let is_new =
            |span: &&Span| ids.contains(&span.parent_span_id) && !ids.contains(&span.span_id);
        let next: Vec<&Span> = spans.iter().filter(is_new).collect();
        if next.is_empty() {
            return found;
        }
        ids.extend(next.iter().map(|span| span.span_id.clone()));
        found.extend(next);
    }
}

#[tokio::test]
async fn a_departure_is_followed_by_its_id_from_the_call_to_the_commit() {
    let (collector, address) = Collector::start().await;
    let mut app = TestApp::with(configured(&address)).await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    assert_eq!(app.sigterm().await.code(), Some(0), "what waits is sent at the end");
    let spans = collector.0.lock().unwrap().clone();
    let id = tour.departure_id.as_str();
    let about: Vec<&Span> =
        spans.iter().filter(|span| attribute(span, "departure") == Some(id)).collect();
    let find = |name: &str| {
        let found = about.iter().find(|span| span.name == name);
        *found.unwrap_or_else(|| panic!("no {name} of {id} in {spans:#?}"))
    };
    let announced = below(&spans, find("/voltour.v1.DepartureService/Announce"));
    assert!(announced.iter().any(|span| span.name == "Announce"), "{announced:#?}");
    let departure = find("departure");
    let names: Vec<&str> = below(&spans, departure).iter().map(|span| span.name.as_str()).collect();
    for step in ["CloseBatch", "plan", "StorePlan", "apply"] {
        assert!(names.contains(&step), "no {step} in {names:?}");
    }
    // A command is linked with the transaction that it was committed in.
    let stored =
        below(&spans, departure).into_iter().find(|span| span.name == "StorePlan").unwrap();
    let linked = &stored.links[0].span_id;
    let transaction = spans.iter().find(|span| span.span_id == *linked).unwrap();
    assert_eq!(transaction.name, "transaction");
    let ours = |span: &Span| span.start_time_unix_nano <= span.end_time_unix_nano;
    assert!(spans.iter().all(ours));
}

#[tokio::test]
async fn a_call_is_a_part_of_its_callers_trace() {
    const TRACE: [u8; 16] = [0xab; 16];
    let (collector, address) = Collector::start().await;
    let mut app = TestApp::with(configured(&address)).await;
    app.put(line(1)).await;
    let mut submit = Request::new(request("s1"));
    let within =
        |span: u8| format!("00-{}-{}-01", "ab".repeat(16), format!("{span:02x}").repeat(8));
    submit.metadata_mut().insert("traceparent", within(1).parse().unwrap());
    app.requests().submit(submit).await.unwrap();
    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    let get = |parent: String| {
        client.get(format!("{}/v1/networks", app.rest)).header("traceparent", parent).send()
    };
    assert_eq!(get(within(2)).await.unwrap().status(), 200);
    assert_eq!(get("00-nonsense-01".into()).await.unwrap().status(), 200);
    assert_eq!(app.sigterm().await.code(), Some(0));
    let spans = collector.0.lock().unwrap().clone();
    for (parent, name) in [(1, "/voltour.v1.RequestService/Submit"), (2, "rest")] {
        let called: Vec<&Span> =
            spans.iter().filter(|span| span.parent_span_id == [parent; 8]).collect();
        assert_eq!(called.iter().map(|span| span.name.as_str()).collect::<Vec<_>>(), [name]);
        assert_eq!(called[0].trace_id, TRACE);
        let all = below(&spans, called[0]);
        assert!(all.iter().all(|span| span.trace_id == TRACE));
        assert_eq!(all.iter().any(|span| span.name == "Submit"), parent == 1, "{all:#?}");
    }
    let alone = |span: &&Span| span.name == "rest" && span.trace_id != TRACE;
    assert_eq!(spans.iter().filter(alone).count(), 1, "nonsense names no trace");
}

#[tokio::test]
async fn a_collector_that_is_not_there_holds_nothing_up() {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let silent = format!("http://{}", listener.local_addr().unwrap());
    // One refuses connections, the other takes them and never says a word.
    for address in ["http://127.0.0.1:1", &silent] {
        let mut app = TestApp::with(configured(address)).await;
        app.put(line(1)).await;
        app.ask("s1").await;
        assert_eq!(app.drive("A").await.stops.len(), 1);
        assert_eq!(app.sigterm().await.code(), Some(0), "{address}");
    }
}
