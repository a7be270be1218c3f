//! Acknowledged durable requests a second: one SubmitStream with 1,000 unacknowledged, against bare
//! sqlx that inserts the same rows into the same table with the same indices, 1,000 a transaction.
//!
//! Both on one disk in one run, in turns; the ratio is what counts. `cargo bench --bench ingest`.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]
#![allow(clippy::disallowed_methods, missing_docs)]

use std::error::Error;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Instant;

use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqliteSynchronous};
use sqlx::{ConnectOptions, Connection, SqliteConnection};
use tokio::sync::{Semaphore, mpsc};
use tokio_stream::wrappers::ReceiverStream;
use tonic::transport::{Channel, Endpoint};
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::network_service_client::NetworkServiceClient;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::{
    ChargerType, NetworkSpec, Objective, Place, Point, PutNetworkRequest, Sensor, SubmitRequest,
    place,
};

/// Requests in a round, each of a sensor of its own.
const REQUESTS: usize = 20_000;
/// Sent and not yet acknowledged; rows in a transaction of the reference.
const UNACKNOWLEDGED: usize = 1_000;
const ROUNDS: usize = 5;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

#[tokio::main]
async fn main() -> Result<()> {
    // Beside the build, not in /tmp: that may be memory.
    let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR"))?;
    let (mut server, channel) = serve(directory.path()).await?;
    let mut bare = open(&directory.path().join("bare.db")).await?;
    println!("{REQUESTS} requests a round, acknowledged and durable, a second:");
    let mut ratios = Vec::new();
    for round in 0..ROUNDS {
        let network = format!("round-{round}");
        put(&channel, &network).await?;
        let service = per_second(stream(&channel, &network)).await?;
        let reference = per_second(insert(&mut bare, &network)).await?;
        ratios.push(service / reference);
        println!(
            "  service {service:>8.0}   bare sqlx {reference:>8.0}   ratio {:.2}",
            service / reference
        );
    }
    ratios.sort_by(f64::total_cmp);
    println!("median ratio {:.2} (to reach: 0.5)", ratios[ROUNDS / 2]);
    server.kill()?;
    server.wait()?;
    Ok(())
}

async fn per_second(work: impl Future<Output = Result<()>>) -> Result<f64> {
    let began = Instant::now();
    work.await?;
    Ok(REQUESTS as f64 / began.elapsed().as_secs_f64())
}

async fn serve(directory: &Path) -> Result<(Child, Channel)> {
    let config = directory.join("voltour.toml");
    let store = directory.join("service.db");
    let text = format!(
        "[grpc]\nlisten = \"127.0.0.1:0\"\n[rest]\nlisten = \"127.0.0.1:0\"\n\
         [store]\npath = {store:?}\n"
    );
    std::fs::write(&config, text)?;
    let mut server = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["serve", "--config"])
        .arg(&config)
        .stdout(Stdio::piped())
        .spawn()?;
    let mut line = String::new();
    BufReader::new(server.stdout.take().ok_or("no output")?).read_line(&mut line)?;
    let grpc = line.split_whitespace().find_map(|word| word.strip_prefix("grpc="));
    let grpc = grpc.ok_or("the server never got ready")?.to_owned();
    Ok((server, Endpoint::from_shared(grpc)?.connect().await?))
}

fn sensor(number: usize) -> String {
    format!("s{number}")
}

async fn put(channel: &Channel, network: &str) -> Result<()> {
    let place = |x_m: f64| Place { place: Some(place::Place::PositionM(Point { x_m, y_m: 0.0 })) };
    let sensors = (0..REQUESTS).map(|number| Sensor {
        id: sensor(number),
        place: Some(place(number as f64)),
        battery_j: 100.0,
        ..Sensor::default()
    });
    let truck = ChargerType {
        name: "truck".into(),
        speed_mps: 10.0,
        travel_jpm: 1.0,
        transfer_w: 20.0,
        start_m: Some(Point { x_m: 0.0, y_m: 0.0 }),
        ..ChargerType::default()
    };
    let spec = NetworkSpec {
        objective: Objective::MaxReward as i32,
        charger_types: vec![truck],
        sensors: sensors.collect(),
        ..NetworkSpec::default()
    };
    let call = PutNetworkRequest {
        client_id: "put".into(),
        network_id: network.into(),
        spec: Some(spec),
        expected_version: None,
    };
    NetworkServiceClient::new(channel.clone()).put(call).await?;
    Ok(())
}

async fn stream(channel: &Channel, network: &str) -> Result<()> {
    let (send, items) = mpsc::channel(64);
    let room = Arc::new(Semaphore::new(UNACKNOWLEDGED));
    let (free, network) = (room.clone(), network.to_owned());
    let sending = tokio::spawn(async move {
        for number in 0..REQUESTS {
            let Ok(permit) = room.acquire().await else { return };
            permit.forget();
            let request = SubmitRequest {
                client_id: format!("c{number}"),
                network_id: network.clone(),
                sensor_id: sensor(number),
                residual_j: Some(50.0),
                ..SubmitRequest::default()
            };
            if send.send(request).await.is_err() {
                return;
            }
        }
    });
    let mut client = RequestServiceClient::new(channel.clone());
    let mut answers = client.submit_stream(ReceiverStream::new(items)).await?.into_inner();
    for number in 0..REQUESTS {
        let answer = answers.message().await?.ok_or("an answer is missing")?;
        if !matches!(answer.result, Some(Outcome::Request(_))) {
            return Err(format!("item {number} was refused: {answer:?}").into());
        }
        free.add_permits(1);
    }
    Ok(sending.await?)
}

async fn open(path: &Path) -> Result<SqliteConnection> {
    let mut conn = SqliteConnectOptions::new()
        .filename(path)
        .create_if_missing(true)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .disable_statement_logging()
        .connect()
        .await?;
    sqlx::migrate!("migrations/sqlite").run(&mut conn).await?;
    Ok(conn)
}

async fn insert(conn: &mut SqliteConnection, network: &str) -> Result<()> {
    sqlx::query("INSERT INTO networks (id, version, created_us, updated_us) VALUES (?, 1, 0, 0)")
        .bind(network)
        .execute(&mut *conn)
        .await?;
    let mut number = 0;
    while number < REQUESTS {
        let mut transaction = conn.begin().await?;
        for number in number..number + UNACKNOWLEDGED {
            sqlx::query(
                "INSERT INTO requests (id, network_id, sensor_id, client_id, fingerprint, state,
                 residual_j, required, received_us, updated_us, change)
                 VALUES (?, ?, ?, ?, ?, 'open', 50.0, 0, ?, ?, ?)",
            )
            .bind(uuid::Uuid::now_v7().to_string())
            .bind(network)
            .bind(sensor(number))
            .bind(format!("c{number}"))
            .bind([number as u8; 32].as_slice())
            .bind(1_700_000_000_000_000 + number as i64)
            .bind(1_700_000_000_000_000 + number as i64)
            .bind(number as i64)
            .execute(&mut *transaction)
            .await?;
        }
        transaction.commit().await?;
        number += UNACKNOWLEDGED;
    }
    Ok(())
}
