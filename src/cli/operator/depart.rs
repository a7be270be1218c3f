//! `voltour depart`.

use jiff::Timestamp;

use super::arguments::{Caller, Common, Point, from_now};
use super::client::{call, refused, unreadable};
use super::show;
use crate::cli::Failure;
use crate::config::Span;
use crate::domain::{Announcement, ChargerId, NetworkId};
use crate::grpc::wire;
use crate::proto::departure_service_client::DepartureServiceClient;

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The network
    #[arg(long, value_name = "ID")]
    pub network: NetworkId,
    /// The charger that leaves
    #[arg(long, value_name = "ID")]
    pub charger: ChargerId,
    /// When it leaves (RFC 3339); as soon as can be if left out
    #[arg(long, value_name = "TIME", conflicts_with = "in_")]
    pub at: Option<Timestamp>,
    /// When it leaves, from now: 30s, 10m
    #[arg(long = "in", id = "in_", value_name = "SPAN")]
    pub in_: Option<Span>,
    /// Its type; may be left out where the network has only one
    #[arg(long = "type", value_name = "NAME")]
    pub kind: Option<ChargerId>,
    /// Where it leaves, in metres; as its type says if left out
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub start: Option<Point>,
    /// Where it must end, in metres; as its type says if left out
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub end: Option<Point>,
    /// Bound on energy delivered plus energy travelled; as its type says if left out
    #[arg(long, value_name = "JOULES", allow_negative_numbers = true)]
    pub capacity_j: Option<f64>,
    /// Bound on the time until it is back; as its type says if left out
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub timespan_s: Option<f64>,
    #[command(flatten)]
    caller: Caller,
    #[command(flatten)]
    common: Common,
}

const EXAMPLES: &str = "\
Examples:
  voltour depart --network north --charger truck-1
  voltour depart --network north --charger truck-1 --in 10m --capacity-j 200000
  voltour tour get --network north --charger truck-1 --wait 30s

The batch of requests closes a lead time before the charger leaves, so that the tour is there then.";

/// Runs the command.
pub async fn run(args: Args) -> Result<(), Failure> {
    let announced = Announcement {
        network_id: args.network,
        charger_id: args.charger,
        charger_type: args.kind.map(String::from),
        t0: args.at.or(args.in_.map(from_now)),
        start_m: args.start.map(|Point(at)| at),
        end_m: args.end.map(|Point(at)| at),
        capacity_j: args.capacity_j,
        timespan_s: args.timespan_s,
    };
    let message = wire::announcement_to_wire(&args.caller.id()?, announced);
    let channel = args.common.remote.connect().await?;
    let mut client = DepartureServiceClient::new(channel);
    let departure = client.announce(call(message)).await.map_err(refused)?.into_inner();
    let departure = wire::departure(departure).map_err(unreadable)?;
    show::item(args.common.json, &departure, show::departure)
}
