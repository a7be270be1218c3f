//! The process: one a database, a clean end, configuration, health and reflection.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;

use prost::Message;
use prost_types::{FileDescriptorProto, FileDescriptorSet};
use tonic::Code;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;
use tonic_types::StatusExt;
use voltour::proto::{AnnounceRequest, GetRequestRequest, SubmitRequest, WatchRequestsRequest};

use crate::app::{PATIENCE, TestApp, wait_exit};
use crate::calls::{OPEN, soon};
use crate::field::{FIELD, departure, line};
use crate::time::from_now;

fn serve() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
    command.arg("serve").stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

#[tokio::test]
async fn a_second_process_on_the_same_database_is_refused() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let mut second = serve().arg("--config").arg(app.config_path()).spawn().unwrap();
    let status = wait_exit(&mut second).await.unwrap_or_else(|| {
        let _ = second.kill();
        panic!("the second process runs");
    });
    assert!(!status.success());
    let output = second.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.stdout.is_empty(), "never ready");
    assert!(said.contains("voltour.db"), "names the database: {said}");
    // The first one does not mind.
    assert_eq!(app.ask("s1").await.state, OPEN);
}

#[tokio::test]
async fn sigterm_ends_it_cleanly_and_loses_nothing() {
    let mut app = TestApp::start().await;
    app.put(line(1)).await;
    let asked = app.ask("s1").await;
    let announced =
        app.announce(AnnounceRequest { t0: from_now(3_600_000), ..departure("A") }).await;
    // Somebody who watches or waits does not keep it from ending.
    let watch = WatchRequestsRequest { network_id: FIELD.into() };
    let mut watching = app.requests().watch(watch).await.unwrap().into_inner();
    let mut tours = app.tours();
    let waiting = tokio::spawn(async move {
        let next = voltour::proto::GetNextRequest {
            network_id: FIELD.into(),
            charger_id: "A".into(),
            departure_id: String::new(),
        };
        tours.get_next(next).await
    });
    soon("the present state", watching.message()).await.unwrap();
    let status = app.sigterm().await;
    assert_eq!(status.code(), Some(0), "{status}");
    assert!(soon("the end of the wait", waiting).await.unwrap().is_err());
    app.launch().await;
    assert_eq!(app.request(&asked.id).await.state, OPEN);
    assert_eq!(app.departure(&announced.id).await, announced);
}

#[tokio::test]
async fn sigterm_in_the_middle_of_planning_loses_nothing() {
    let mut app = TestApp::start().await;
    app.put(line(3)).await;
    app.ask("s1").await;
    let announced = app.depart("A").await;
    tokio::time::sleep(std::time::Duration::from_millis(100)).await;
    assert_eq!(app.sigterm().await.code(), Some(0));
    app.launch().await;
    let tour = app.tour(&announced).await;
    assert_eq!((tour.revision, tour.stops.len()), (1, 1));
}

#[tokio::test]
async fn health_and_reflection_answer() {
    let app = TestApp::start().await;
    let mut health = HealthClient::new(app.channel());
    for service in ["", "voltour.v1.RequestService", "voltour.v1.TourService"] {
        let check = HealthCheckRequest { service: service.into() };
        let answer = health.check(check).await.unwrap().into_inner();
        assert_eq!(answer.status, ServingStatus::Serving as i32, "{service:?}");
    }
    use tonic_reflection::pb::v1::server_reflection_client::ServerReflectionClient;
    use tonic_reflection::pb::v1::server_reflection_request::MessageRequest;
    use tonic_reflection::pb::v1::server_reflection_response::MessageResponse;
    let list = tonic_reflection::pb::v1::ServerReflectionRequest {
        host: String::new(),
        message_request: Some(MessageRequest::ListServices(String::new())),
    };
    let mut reflection = ServerReflectionClient::new(app.channel());
    let mut answers =
        reflection.server_reflection_info(tokio_stream::once(list)).await.unwrap().into_inner();
    let answer = soon("reflection", answers.message()).await.unwrap().unwrap();
    let Some(MessageResponse::ListServicesResponse(list)) = answer.message_response else {
        panic!("{answer:?}")
    };
    for name in ["NetworkService", "RequestService", "DepartureService", "TourService"] {
        let name = format!("voltour.v1.{name}");
        assert!(list.service.iter().any(|service| service.name == name), "{name}");
    }
}

#[tokio::test]
async fn every_service_says_that_it_serves_no_more_while_the_process_ends() {
    let mut app = TestApp::start().await;
    let mut watches = Vec::new();
    for service in ["", "voltour.v1.NetworkService", "voltour.v1.DepartureService"] {
        let check = HealthCheckRequest { service: service.into() };
        let mut health = HealthClient::new(app.channel());
        let mut watch = health.watch(check).await.unwrap().into_inner();
        let first = soon("the present state", watch.message()).await.unwrap().unwrap();
        assert_eq!(first.status(), ServingStatus::Serving, "{service:?}");
        watches.push(watch);
    }
    let unknown = HealthCheckRequest { service: "voltour.v1.Nothing".into() };
    let refused = HealthClient::new(app.channel()).check(unknown).await.unwrap_err();
    assert_eq!(refused.code(), Code::NotFound);
    assert_eq!(app.sigterm().await.code(), Some(0));
    for mut watch in watches {
        let last = soon("the last state", watch.message()).await.unwrap().unwrap();
        assert_eq!(last.status(), ServingStatus::NotServing);
        assert!(!matches!(soon("the end", watch.message()).await, Ok(Some(_))));
    }
}

#[tokio::test]
async fn errors_carry_what_a_program_needs_to_know() {
    let app = TestApp::start().await;
    let missing = GetRequestRequest { request_id: "0190163d-8694-739b-8ca7-c9f6e6a7b0a1".into() };
    let refused = app.requests().get(missing).await.unwrap_err();
    assert_eq!(refused.code(), Code::NotFound);
    let resource = refused.get_details_resource_info().expect("which thing");
    assert_eq!(resource.resource_type, "request");
    assert_eq!(resource.resource_name, "0190163d-8694-739b-8ca7-c9f6e6a7b0a1");
    let refused = app.requests().submit(SubmitRequest::default()).await.unwrap_err();
    let fields = refused.get_details_bad_request().expect("which fields").field_violations;
    let names: Vec<_> = fields.iter().map(|violation| violation.field.as_str()).collect();
    assert_eq!(names, ["client_id", "network_id", "sensor_id"]);
    assert!(fields.iter().all(|violation| !violation.description.is_empty()));
}

#[tokio::test]
async fn reflection_shows_the_very_contract() {
    use tonic_reflection::pb::v1::server_reflection_client::ServerReflectionClient;
    use tonic_reflection::pb::v1::server_reflection_request::MessageRequest;
    use tonic_reflection::pb::v1::server_reflection_response::MessageResponse;
    let app = TestApp::start().await;
    let symbol = MessageRequest::FileContainingSymbol("voltour.v1.TourService".to_owned());
    let ask = tonic_reflection::pb::v1::ServerReflectionRequest {
        host: String::new(),
        message_request: Some(symbol),
    };
    let mut reflection = ServerReflectionClient::new(app.channel());
    let answers = reflection.server_reflection_info(tokio_stream::once(ask)).await.unwrap();
    let answer = soon("reflection", answers.into_inner().message()).await.unwrap().unwrap();
    let Some(MessageResponse::FileDescriptorResponse(files)) = answer.message_response else {
        panic!("{answer:?}")
    };
    let shown: Vec<_> = files
        .file_descriptor_proto
        .iter()
        .map(|file| FileDescriptorProto::decode(file.as_slice()).unwrap())
        .collect();
    let built = FileDescriptorSet::decode(voltour::proto::DESCRIPTORS).unwrap();
    let tour = built.file.iter().find(|file| file.name() == "voltour/v1/tour.proto").unwrap();
    assert!(shown.contains(tour), "the contract that the server was built with");
}

#[tokio::test]
async fn a_bad_configuration_is_refused_with_the_name_of_the_field() {
    let app = TestApp::start().await;
    for (text, field) in [
        ("[planning]\nbudget = \"soon\"\n", "budget"),
        ("[planning]\nsolver = \"oracle\"\n", "solver"),
        ("[planning]\nbudgett = \"1s\"\n", "budgett"),
        ("[grpc]\nlisten = \"everywhere\"\n", "listen"),
        // As long as there is no authentication.
        ("[grpc]\nlisten = \"0.0.0.0:0\"\n", "listen"),
        ("[rest]\nlisten = \"0.0.0.0:0\"\n", "listen"),
    ] {
        let path = app.file("bad.toml");
        let store = format!("[store]\npath = {:?}\n", app.file("bad.db"));
        std::fs::write(&path, format!("{text}\n{store}")).unwrap();
        let mut server = serve().arg("--config").arg(&path).spawn().unwrap();
        let status = wait_exit(&mut server).await.unwrap_or_else(|| {
            let _ = server.kill();
            panic!("it runs with {text:?}");
        });
        let output = server.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(status.code(), Some(2), "{text:?}: {said}");
        assert!(said.contains(field), "{text:?}: {said}");
        assert!(output.stdout.is_empty());
    }
}

/// What something comes to that would wait for ever where the server does not do its part.
fn in_time<T: Send + 'static>(what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (send, done) = mpsc::channel();
    thread::spawn(move || send.send(work()));
    done.recv_timeout(PATIENCE).unwrap_or_else(|_| panic!("{what} never came"))
}

/// A server whose start waits for a model that comes through a pipe; the end of the pipe, once it does.
fn starting(app: &TestApp) -> (Child, File) {
    let (folder, store) = (app.file("models"), app.file("starting.db"));
    std::fs::create_dir(&folder).unwrap();
    let pipe = folder.join("reward.onnx");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let server = serve()
        .arg("--config")
        .arg(app.config_path())
        .env("VOLTOUR_STORE__PATH", store)
        .env("VOLTOUR_POLICY__FOLDER", folder)
        .spawn()
        .unwrap();
    // Opened once the other end is.
    let opened = pipe.clone();
    let end = in_time("the start", move || File::options().write(true).open(opened).unwrap());
    std::fs::remove_file(&pipe).unwrap();
    (server, end)
}

fn send(signal: &str, server: &Child) {
    let pid = server.id().to_string();
    assert!(Command::new("kill").args([signal, &pid]).status().unwrap().success());
}

#[tokio::test]
async fn a_hangup_during_the_start_does_not_end_it() {
    let app = TestApp::start().await;
    let (mut server, end) = starting(&app);
    send("-HUP", &server);
    drop(end);
    let stdout = BufReader::new(server.stdout.take().unwrap());
    let line = in_time("the first line", || stdout.lines().next());
    let line = line.and_then(Result::ok).unwrap_or_default();
    send("-TERM", &server);
    let status = wait_exit(&mut server).await;
    let _ = server.kill();
    assert!(line.starts_with("voltour ready "), "{line:?}, {status:?}");
    assert_eq!(status.and_then(|status| status.code()), Some(0));
}

#[tokio::test]
async fn a_second_signal_during_the_start_ends_it_at_once() {
    let app = TestApp::start().await;
    let (mut server, _end) = starting(&app);
    let mut said = BufReader::new(server.stderr.take().unwrap()).lines().map_while(Result::ok);
    // Two of which nothing is heard in between are one to the process.
    send("-TERM", &server);
    assert!(in_time("the first signal", move || said.any(|line| line.contains("stopping"))));
    send("-TERM", &server);
    let status = wait_exit(&mut server).await;
    let _ = server.kill();
    assert_eq!(status.and_then(|status| status.code()), Some(1));
}

#[tokio::test]
async fn the_environment_overrides_the_file() {
    let app = TestApp::start().await;
    let mut server = serve()
        .arg("--config")
        .arg(app.config_path())
        .env("VOLTOUR_STORE__PATH", app.file("other.db"))
        .env("VOLTOUR_PLANNING__BUDGET", "soon")
        .spawn()
        .unwrap();
    let status = wait_exit(&mut server).await;
    let _ = server.kill();
    let output = server.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(status.and_then(|status| status.code()), Some(2), "{said}");
    assert!(said.to_lowercase().contains("budget"), "{said}");
}
