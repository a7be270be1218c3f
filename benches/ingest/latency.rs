//! How long an acknowledgement takes while nothing is planned, and while something is.
//!
//! Requests come at a steady pace on one stream, so that neither waits for the other: what is measured is the service, not a
//! queue that the client has filled. Idle and planning take turns, each long enough that its 99th percentile is of many.

use std::path::Path;
use std::time::{Duration, Instant};

use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::Request;
use tonic::transport::Channel;
use voltour::proto::departure_service_client::DepartureServiceClient;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::tour_service_client::TourServiceClient;
use voltour::proto::{
    AnnounceRequest, CompleteRequest, Departure, DepartureState, GetDepartureRequest,
    GetNextRequest,
};

use super::Result;
use super::service::{put, request, sensor, serve};

const TURNS: usize = 3;
/// Requests of a turn, and what lies between two of them.
const TURN: usize = 2_000;
const PACE: Duration = Duration::from_millis(2);
/// Requests in the batch that is planned: more than can be proven in the time.
const BATCH: usize = 1_000;
/// Longer than a turn takes.
const PLANNING: &str = "budget = \"8s\"\nexplanation_budget = \"0s\"\nthreads = 1";

/// Prints both 99th percentiles and their ratio.
pub async fn measure(directory: &Path) -> Result<()> {
    let (mut server, channel) = serve(directory, PLANNING).await?;
    put(&channel, "paced", TURN).await?;
    put(&channel, "planned", BATCH).await?;
    let (mut idle, mut planning) = (Vec::new(), Vec::new());
    for turn in 0..TURNS {
        idle.extend(paced(&channel, &format!("idle-{turn}")).await?);
        fill(&channel, turn).await?;
        let departure = announce(&channel, turn).await?;
        planning.extend(paced(&channel, &format!("planning-{turn}")).await?);
        still_planned(&channel, &departure).await?;
        end(&channel, &departure).await?;
    }
    let (idle, planning) = (p99_ms(&mut idle), p99_ms(&mut planning));
    println!(
        "p99 of an acknowledgement: idle {idle:.2} ms, while a plan is computed {planning:.2} ms, \
         ratio {:.2} (to reach: at most 3)",
        planning / idle
    );
    server.kill()?;
    server.wait()?;
    Ok(())
}

/// The time to each acknowledgement of a turn.
async fn paced(channel: &Channel, name: &str) -> Result<Vec<Duration>> {
    let (send, items) = mpsc::channel(TURN);
    let (tell, mut told) = mpsc::channel(TURN);
    let name = name.to_owned();
    let sending = tokio::spawn(async move {
        let mut pace = tokio::time::interval(PACE);
        for number in 0..TURN {
            pace.tick().await;
            let request = request("paced", sensor(number), format!("{name}-{number}"));
            if tell.send(Instant::now()).await.is_err() || send.send(request).await.is_err() {
                return;
            }
        }
    });
    let mut client = RequestServiceClient::new(channel.clone());
    let mut answers = client.submit_stream(ReceiverStream::new(items)).await?.into_inner();
    let mut took = Vec::with_capacity(TURN);
    while answers.message().await?.is_some() {
        took.push(told.recv().await.ok_or("an answer without a request")?.elapsed());
    }
    sending.await?;
    if took.len() == TURN { Ok(took) } else { Err("an answer is missing".into()) }
}

/// A request of every sensor of the network that is planned.
async fn fill(channel: &Channel, turn: usize) -> Result<()> {
    let ask = move |number| request("planned", sensor(number), format!("batch-{turn}-{number}"));
    let items = tokio_stream::iter((0..BATCH).map(ask));
    let mut client = RequestServiceClient::new(channel.clone());
    let mut answers = client.submit_stream(items).await?.into_inner();
    while answers.message().await?.is_some() {}
    Ok(())
}

/// A departure as soon as can be: its batch closes at once, and its plan begins.
async fn announce(channel: &Channel, turn: usize) -> Result<Departure> {
    let call = AnnounceRequest {
        client_id: format!("leave-{turn}"),
        network_id: "planned".into(),
        charger_id: "truck-1".into(),
        ..AnnounceRequest::default()
    };
    let announced = DepartureServiceClient::new(channel.clone()).announce(call).await?.into_inner();
    let mut state = announced.state();
    while state == DepartureState::Announced {
        tokio::time::sleep(Duration::from_millis(10)).await;
        state = departure(channel, &announced.id).await?.state();
    }
    Ok(announced)
}

async fn departure(channel: &Channel, id: &str) -> Result<Departure> {
    let get = GetDepartureRequest { departure_id: id.to_owned() };
    Ok(DepartureServiceClient::new(channel.clone()).get(get).await?.into_inner())
}

/// A plan that was ready before the turn ended would have made the rest of it idle.
async fn still_planned(channel: &Channel, announced: &Departure) -> Result<()> {
    match departure(channel, &announced.id).await?.state() {
        DepartureState::Closed => Ok(()),
        other => Err(format!("the departure is {other:?} before its turn is over").into()),
    }
}

async fn end(channel: &Channel, departure: &Departure) -> Result<()> {
    let mut next = Request::new(GetNextRequest {
        network_id: "planned".into(),
        charger_id: "truck-1".into(),
        departure_id: departure.id.clone(),
    });
    next.set_timeout(Duration::from_secs(60));
    let mut tours = TourServiceClient::new(channel.clone());
    let tour = tours.get_next(next).await?.into_inner();
    let done = CompleteRequest { client_id: "done".into(), tour_id: tour.id };
    tours.complete(done).await?;
    Ok(())
}

fn p99_ms(took: &mut [Duration]) -> f64 {
    took.sort();
    took[took.len() * 99 / 100].as_secs_f64() * 1e3
}
