//! The base station: hears of batteries that run down, and submits a request for each.

use std::sync::Arc;
use std::time::Duration;

use super::stage::Play;
use super::world::Due;
use crate::cli::Failure;
use crate::cli::operator::{Service, call, fresh_id, refused};
use crate::clock::plus;
use crate::domain::{NetworkSpec, NewRequest};
use crate::grpc::wire;
use crate::proto::acknowledgement::Result as Outcome;
use crate::proto::network_service_client::NetworkServiceClient;
use crate::proto::request_service_client::RequestServiceClient;
use crate::proto::{PutNetworkRequest, SubmitRequest};

const WHO: &str = "base station";
/// How often it hears of the batteries, on stage.
const HEARS: Duration = Duration::from_secs(120);

/// Registers the network.
pub(super) async fn register(play: &Play, spec: &NetworkSpec) -> Result<(), Failure> {
    let message = PutNetworkRequest {
        client_id: fresh_id()?.into(),
        network_id: play.network.as_str().to_owned(),
        spec: Some(wire::spec_to_wire(spec)),
        expected_version: None,
    };
    let mut client = NetworkServiceClient::new(play.channel.clone());
    client.put(call(message)).await.map_err(refused)?;
    let what = format!("registers network {} with {} sensors", play.network, spec.sensors.len());
    play.teller.tell(play.clock.now(), WHO, &what);
    Ok(())
}

/// Plays until it is stopped.
pub(super) async fn play(play: Arc<Play>) -> Result<(), Failure> {
    let mut client = RequestServiceClient::new(play.channel.clone());
    loop {
        let due = play.world.due(play.clock.now());
        if !due.is_empty() {
            submit(&play, &mut client, due).await?;
        }
        play.clock.sleep_until(plus(play.clock.now(), HEARS)).await;
    }
}

/// Submits what is due, over one stream.
async fn submit(
    play: &Play,
    client: &mut RequestServiceClient<Service>,
    due: Vec<Due>,
) -> Result<(), Failure> {
    let messages: Vec<SubmitRequest> =
        due.iter().map(|due| message(play, due)).collect::<Result<_, _>>()?;
    let answers = client.submit_stream(tokio_stream::iter(messages)).await.map_err(refused)?;
    let mut answers = answers.into_inner();
    let mut asked = Vec::new();
    while let Some(answer) = answers.message().await.map_err(refused)? {
        let item = usize::try_from(answer.position).ok().and_then(|at| due.get(at));
        match (answer.result, item) {
            (Some(Outcome::Request(_)), Some(item)) => {
                play.world.asked(item);
                let percent = 100.0 * item.residual_j / play.full_j(&item.sensor);
                asked.push(match item.deadline {
                    Some(at) => {
                        format!("{} ({percent:.0} %, until {})", item.sensor, play.teller.time(at))
                    }
                    None => format!("{} (empty)", item.sensor),
                });
            }
            (Some(Outcome::Refused(refusal)), _) => {
                let what = format!("a request was refused: {}", refusal.message);
                play.teller.tell(play.clock.now(), WHO, &what);
            }
            _ => return Err(Failure::other("an acknowledgement belongs to no request")),
        }
    }
    if !asked.is_empty() {
        let what = format!("asks to charge {}", asked.join(", "));
        play.teller.tell(play.clock.now(), WHO, &what);
    }
    Ok(())
}

fn message(play: &Play, due: &Due) -> Result<SubmitRequest, Failure> {
    let asked = NewRequest {
        network_id: play.network.clone(),
        sensor_id: due.sensor.clone(),
        place: None,
        deadline: due.deadline,
        ready: None,
        residual_j: Some(due.residual_j),
        measured_at: None,
        drain_w: Some(due.drain_w),
        reward: None,
        required: false,
    };
    Ok(wire::new_request_to_wire(&fresh_id()?, asked))
}
