//! The service: its process, its networks, and streams of requests to it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;

use tokio::sync::{Semaphore, mpsc};
use tokio::task::JoinSet;
use tokio_stream::wrappers::ReceiverStream;
use tonic::transport::{Channel, Endpoint};
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::network_service_client::NetworkServiceClient;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::{
    ChargerType, NetworkSpec, Objective, Place, Point, PutNetworkRequest, Sensor, SubmitRequest,
    place,
};

use super::{REQUESTS, Result, UNACKNOWLEDGED};

/// Starts it on a database of its own, with this for `[planning]`.
pub async fn serve(directory: &Path, planning: &str) -> Result<(Child, Channel)> {
    let config = directory.join("voltour.toml");
    let store = directory.join("service.db");
    let text = format!(
        "[grpc]\nlisten = \"127.0.0.1:0\"\n[rest]\nlisten = \"127.0.0.1:0\"\n\
         [store]\npath = {store:?}\n[planning]\n{planning}\n"
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

/// The name of a sensor.
pub fn sensor(number: usize) -> String {
    format!("s{number}")
}

/// What every request of the bench says.
pub fn request(network: &str, sensor_id: String, client_id: String) -> SubmitRequest {
    SubmitRequest {
        client_id,
        network_id: network.to_owned(),
        sensor_id,
        residual_j: Some(50.0),
        ..SubmitRequest::default()
    }
}

/// A network of so many sensors in rows of a hundred, and a charger that cannot serve many of them.
pub async fn put(channel: &Channel, network: &str, sensors: usize) -> Result<()> {
    let place = |number: usize| {
        let (x_m, y_m) = ((number % 100) as f64 * 10.0, (number / 100) as f64 * 10.0);
        Place { place: Some(place::Place::PositionM(Point { x_m, y_m })) }
    };
    let sensors = (0..sensors).map(|number| Sensor {
        id: sensor(number),
        place: Some(place(number)),
        battery_j: 100.0,
        ..Sensor::default()
    });
    let truck = ChargerType {
        name: "truck".into(),
        speed_mps: 10.0,
        travel_jpm: 1.0,
        transfer_w: 20.0,
        capacity_j: Some(5_000.0),
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

/// A round's requests over so many streams of one connection; all are acknowledged when it returns.
pub async fn streams(channel: &Channel, network: &str, count: usize) -> Result<()> {
    let (share, room) = (REQUESTS / count, UNACKNOWLEDGED.div_ceil(count));
    let mut all = JoinSet::new();
    for index in 0..count {
        let (channel, network) = (channel.clone(), network.to_owned());
        all.spawn(async move {
            let streamed = stream(&channel, &network, index * share..(index + 1) * share, room);
            streamed.await.map_err(|error| error.to_string())
        });
    }
    while let Some(streamed) = all.join_next().await {
        streamed??;
    }
    Ok(())
}

async fn stream(
    channel: &Channel,
    network: &str,
    numbers: std::ops::Range<usize>,
    room: usize,
) -> Result<()> {
    let (send, items) = mpsc::channel(64);
    let room = Arc::new(Semaphore::new(room));
    let (free, network, asked) = (room.clone(), network.to_owned(), numbers.clone());
    let sending = tokio::spawn(async move {
        for number in asked {
            let Ok(permit) = room.acquire().await else { return };
            permit.forget();
            let request = request(&network, sensor(number), format!("c{number}"));
            if send.send(request).await.is_err() {
                return;
            }
        }
    });
    let mut client = RequestServiceClient::new(channel.clone());
    let mut answers = client.submit_stream(ReceiverStream::new(items)).await?.into_inner();
    for number in numbers {
        let answer = answers.message().await?.ok_or("an answer is missing")?;
        if !matches!(answer.result, Some(Outcome::Request(_))) {
            return Err(format!("item {number} was refused: {answer:?}").into());
        }
        free.add_permits(1);
    }
    Ok(sending.await?)
}
