//! `voltour request`.

use std::path::PathBuf;

use clap::{Subcommand, ValueEnum};
use jiff::Timestamp;

use super::arguments::{Caller, Common, Point, from_now};
use super::client::{MESSAGE_BYTES, call, refused, unreadable};
use super::remote::Service;
use super::{ndjson, show};
use crate::cli::Failure;
use crate::config::Span;
use crate::domain::{NetworkId, NewRequest, Place, RequestState, SensorId};
use crate::grpc::wire;
use crate::proto::ListRequestsRequest;
use crate::proto::request_service_client::RequestServiceClient;

/// What to do with requests.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Submit one request, or a file of them
    #[command(after_long_help = EXAMPLES)]
    Submit(Box<Submit>),
    /// List requests, newest first
    List(List),
}

const EXAMPLES: &str = r#"Examples:
  voltour request submit --network north --sensor s1 --in 90m --residual-j 1620 --drain-w 0.3
  voltour request submit --network north --file requests.ndjson

A file has one JSON object a line; only sensor_id must be there (and network_id, without --network):
  {"sensor_id": "s1", "deadline": "2030-01-01T12:00:00Z", "residual_j": 1620, "drain_w": 0.3}
  {"sensor_id": "s2", "client_id": "s2-17", "reward": 9180, "required": true}
Fields beside these: network_id, ready, measured_at, and place as {"position_m": [90, 40]}."#;

/// Arguments of `submit`.
#[derive(Debug, clap::Args)]
pub struct Submit {
    /// The network
    #[arg(long, value_name = "ID", required_unless_present = "file")]
    pub network: Option<NetworkId>,
    /// The sensor that asks to be charged
    #[arg(long, value_name = "ID", required_unless_present = "file")]
    pub sensor: Option<SensorId>,
    /// Charging must begin at or before this time (RFC 3339)
    #[arg(long, value_name = "TIME", conflicts_with = "in_")]
    pub deadline: Option<Timestamp>,
    /// The deadline, from now: 90m, 1h 30m
    #[arg(long = "in", id = "in_", value_name = "SPAN")]
    pub in_: Option<Span>,
    /// Charging may not begin before this time (RFC 3339)
    #[arg(long, value_name = "TIME")]
    pub ready: Option<Timestamp>,
    /// Energy left in its battery
    #[arg(long, value_name = "JOULES", allow_negative_numbers = true)]
    pub residual_j: Option<f64>,
    /// When that was measured (RFC 3339); now if left out
    #[arg(long, value_name = "TIME")]
    pub measured_at: Option<Timestamp>,
    /// Its consumption; as registered if left out
    #[arg(long, value_name = "WATTS", allow_negative_numbers = true)]
    pub drain_w: Option<f64>,
    /// What serving it is worth; the energy needed if left out
    #[arg(long, allow_negative_numbers = true)]
    pub reward: Option<f64>,
    /// The tour must serve it
    #[arg(long)]
    pub required: bool,
    /// Where the sensor is, in metres; as registered if left out
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub position: Option<Point>,
    /// Submit the requests of this file instead, one JSON object a line; - is standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = [
        "sensor", "deadline", "in_", "ready", "residual_j", "measured_at", "drain_w", "reward",
        "required", "position", "client_id",
    ])]
    pub file: Option<PathBuf>,
    #[command(flatten)]
    caller: Caller,
    #[command(flatten)]
    common: Common,
}

/// Arguments of `list`.
#[derive(Debug, clap::Args)]
pub struct List {
    /// Of this network only
    #[arg(long, value_name = "ID")]
    pub network: Option<NetworkId>,
    /// Of this sensor only
    #[arg(long, value_name = "ID")]
    pub sensor: Option<SensorId>,
    /// In this state only; may be repeated
    #[arg(long)]
    pub state: Vec<State>,
    /// Show at most so many
    #[arg(long, default_value_t = 50)]
    pub limit: usize,
    #[command(flatten)]
    common: Common,
}

/// States of requests.
#[derive(Clone, Copy, Debug, ValueEnum)]
#[allow(missing_docs)]
pub enum State {
    Open,
    Batched,
    Planned,
    Served,
    Expired,
    Withdrawn,
    Superseded,
}

impl From<State> for RequestState {
    fn from(state: State) -> Self {
        match state {
            State::Open => Self::Open,
            State::Batched => Self::Batched,
            State::Planned => Self::Planned,
            State::Served => Self::Served,
            State::Expired => Self::Expired,
            State::Withdrawn => Self::Withdrawn,
            State::Superseded => Self::Superseded,
        }
    }
}

/// Runs a command.
pub async fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Submit(args) => submit(*args).await,
        Command::List(args) => list(args).await,
    }
}

async fn submit(args: Submit) -> Result<(), Failure> {
    let (network, sensor) = match (args.file, args.network, args.sensor) {
        (Some(file), network, _) => {
            let client = connect(&args.common).await?;
            return ndjson::submit(client, file, network, args.common.json).await;
        }
        (None, Some(network), Some(sensor)) => (network, sensor),
        _ => return Err(Failure::input("--network and --sensor are needed, or --file")),
    };
    let asked = NewRequest {
        network_id: network,
        sensor_id: sensor,
        place: args.position.map(|Point(at)| Place::PositionM(at)),
        deadline: args.deadline.or(args.in_.map(from_now)),
        ready: args.ready,
        residual_j: args.residual_j,
        measured_at: args.measured_at,
        drain_w: args.drain_w,
        reward: args.reward,
        required: args.required,
    };
    let message = wire::new_request_to_wire(&args.caller.id()?, asked);
    let mut client = connect(&args.common).await?;
    let request = client.submit(call(message)).await.map_err(refused)?.into_inner();
    let request = wire::request(request).map_err(unreadable)?;
    show::item(args.common.json, &request, show::request)
}

async fn list(args: List) -> Result<(), Failure> {
    let mut client = connect(&args.common).await?;
    let states: Vec<i32> = args
        .state
        .into_iter()
        .map(|state| wire::request_state_to_wire(state.into()).into())
        .collect();
    let (mut left, mut page_token) = (args.limit, String::new());
    while left > 0 {
        let message = ListRequestsRequest {
            network_id: args.network.clone().map(String::from).unwrap_or_default(),
            states: states.clone(),
            sensor_id: args.sensor.clone().map(String::from).unwrap_or_default(),
            page_size: u32::try_from(left.min(500)).unwrap_or(500),
            page_token,
        };
        let page = client.list(call(message)).await.map_err(refused)?.into_inner();
        left = left.saturating_sub(page.requests.len());
        for request in page.requests {
            let request = wire::request(request).map_err(unreadable)?;
            show::item(args.common.json, &request, show::request)?;
        }
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    Ok(())
}

async fn connect(common: &Common) -> Result<RequestServiceClient<Service>, Failure> {
    let channel = common.remote.connect().await?;
    Ok(RequestServiceClient::new(channel).max_decoding_message_size(MESSAGE_BYTES))
}
