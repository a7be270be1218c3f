//! A database that is full, locked or damaged, as its clients and its operator see it.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;

use sqlx::Connection;
use tonic::Code;
use tonic::transport::{Channel, Endpoint};
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;
use tonic_types::StatusExt;
use voltour::app::App;
use voltour::clock::SystemClock;
use voltour::config::Config;
use voltour::lifecycle::Lifecycle;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::{GetRequestRequest, SubmitRequest};
use voltour::telemetry::LogFilter;
use voltour_power_loss::{Disk, Fault};

use crate::app::{Settings, TestApp, wait_exit};
use crate::calls::OPEN;
use crate::database::open_copy;
use crate::field::{self, line, request};
use crate::time::until;

async fn serving(channel: Channel) -> ServingStatus {
    let asked = HealthCheckRequest { service: "voltour.v1.RequestService".into() };
    let told = HealthClient::new(channel).check(asked).await.expect("Check");
    told.into_inner().status()
}

async fn ready(rest: &str) -> (u16, String) {
    let told = reqwest::get(format!("{rest}/readyz")).await.expect("an answer");
    (told.status().as_u16(), told.text().await.expect("a text"))
}

/// In this process, for the disk is a layer under its SQLite.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_full_disk_is_told_and_forgotten_when_there_is_room() {
    let dir = tempfile::tempdir().unwrap();
    let disk = Disk::over(dir.path()).unwrap();
    let mut config = Config::default();
    config.store.path = dir.path().join("voltour.db");
    config.grpc.listen.set_port(0);
    config.rest.listen.set_port(0);
    let lifecycle = Lifecycle::default();
    let stop = lifecycle.soft.clone();
    let app = App::start(&config, Arc::new(SystemClock), lifecycle, LogFilter::default())
        .await
        .expect("it starts");
    let rest = format!("http://{}", app.rest);
    let grpc = Endpoint::from_shared(format!("http://{}", app.grpc)).unwrap();
    let channel = grpc.connect().await.expect("a connection");
    let running = tokio::spawn(app.run());
    let mut networks =
        voltour::proto::network_service_client::NetworkServiceClient::new(channel.clone());
    let mut requests = RequestServiceClient::new(channel.clone());
    networks.put(field::put(line(3))).await.expect("Put");
    let stored = requests.submit(request("s1")).await.expect("Submit").into_inner();
    assert_eq!(serving(channel.clone()).await, ServingStatus::Serving);

    disk.fail(Some(Fault::Full));
    let call: SubmitRequest = request("s2");
    let refused = requests.submit(call.clone()).await.expect_err("no room");
    assert_eq!(refused.code(), Code::ResourceExhausted);
    assert!(refused.message().contains("disk of the database is full"), "{refused}");
    assert!(refused.get_details_retry_info().is_some(), "when to try again");
    until("it serves no more", async || {
        (serving(channel.clone()).await == ServingStatus::NotServing).then_some(())
    })
    .await;
    let (status, text) = ready(&rest).await;
    assert!(status == 503 && text.contains("is full"), "{status} {text}");
    let get = GetRequestRequest { request_id: stored.id.clone() };
    assert_eq!(requests.get(get.clone()).await.expect("Get").into_inner(), stored);

    disk.fail(None);
    until("it serves again", async || {
        (serving(channel.clone()).await == ServingStatus::Serving).then_some(())
    })
    .await;
    assert_eq!(ready(&rest).await.0, 200);
    assert_eq!(requests.submit(call).await.expect("Submit").into_inner().state, OPEN);
    assert_eq!(requests.get(get).await.expect("Get").into_inner(), stored);
    stop.cancel();
    running.await.unwrap().expect("a good end");
}

#[tokio::test]
async fn a_locked_database_is_told_and_forgotten_when_the_lock_is_gone() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let stored = app.ask("s1").await;
    let mut other = open_copy(&app.database()).await;
    sqlx::query("BEGIN IMMEDIATE").execute(&mut other).await.unwrap();
    let refused = app.requests().submit(request("s2")).await.expect_err("it is locked");
    assert_eq!(refused.code(), Code::Unavailable);
    assert!(refused.message().contains("another process holds the database locked"), "{refused}");
    assert_eq!(app.request(&stored.id).await, stored);
    assert!(app.log().contains("locked"), "{}", app.log());
    sqlx::query("ROLLBACK").execute(&mut other).await.unwrap();
    other.close().await.unwrap();
    let again = until("it is stored", async || {
        app.requests().submit(request("s2")).await.ok().map(tonic::Response::into_inner)
    });
    assert_eq!(again.await.state, OPEN);
}

/// Overwrites every page but the first.
fn damage(database: &Path) {
    let mut bytes = fs::read(database).unwrap();
    for page in bytes.chunks_mut(4096).skip(1) {
        page[..64].fill(0xa5);
    }
    // In place, as a bad disk would do it.
    let file = fs::File::options().write(true).open(database).unwrap();
    std::os::unix::fs::FileExt::write_all_at(&file, &bytes, 0).unwrap();
}

#[tokio::test]
async fn a_database_that_is_damaged_while_it_runs_ends_the_service_with_its_reason() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    app.sigterm().await;
    app.launch().await;
    damage(&app.database());
    let refused = app.requests().submit(request("s2")).await.expect_err("it is damaged");
    assert_eq!(refused.code(), Code::Unavailable, "{refused}");
    let status = app.ended().await;
    assert_eq!(status.code(), Some(1));
    let log = app.log();
    assert!(log.contains("the database is damaged"), "{log}");
}

#[tokio::test]
async fn a_database_that_is_damaged_or_newer_is_refused_at_the_start() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    app.sigterm().await;
    let whole = fs::read(app.database()).unwrap();
    let refused = async |says: &str| {
        let mut serve = Command::new(env!("CARGO_BIN_EXE_voltour"));
        serve.arg("serve").arg("--config").arg(app.config_path());
        let piped = serve.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().unwrap();
        let status = wait_exit(&mut child).await.expect("it ends");
        let said = String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap();
        assert_eq!(status.code(), Some(1), "{said}");
        assert!(said.contains("voltour.db") && said.contains(says), "{said}");
    };
    damage(&app.database());
    refused("is damaged: ").await;
    refused("voltour restore").await;
    fs::write(app.database(), "not a database at all, but a text of some length").unwrap();
    refused("file is not a database").await;
    fs::write(app.database(), &whole).unwrap();
    let mut conn = open_copy(&app.database()).await;
    let newer = "INSERT INTO _sqlx_migrations SELECT 99, 'later', installed_on, success, checksum, 0 \
                 FROM _sqlx_migrations WHERE version = 1";
    sqlx::query(newer).execute(&mut conn).await.unwrap();
    conn.close().await.unwrap();
    refused("its schema has version 99").await;
    refused("a newer voltour made it").await;
    fs::write(app.database(), whole).unwrap();
    app.configure(Settings::default());
    app.launch().await;
    assert_eq!(app.ask("s2").await.state, OPEN);
}
