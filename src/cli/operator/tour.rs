//! `voltour tour`.

use std::time::Duration;

use clap::Subcommand;

use super::arguments::Common;
use super::client::{MESSAGE_BYTES, refused, unreadable, waiting};
use super::show;
use crate::cli::Failure;
use crate::config::Span;
use crate::domain::{ChargerId, DepartureId, NetworkId};
use crate::grpc::wire;
use crate::proto::GetNextRequest;
use crate::proto::tour_service_client::TourServiceClient;

/// What to do with tours.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The tour that a charger is on or has to drive next; waits for its plan
    Get(Get),
}

/// Arguments of `get`.
#[derive(Debug, clap::Args)]
pub struct Get {
    /// The network
    #[arg(long, value_name = "ID")]
    pub network: NetworkId,
    /// The charger
    #[arg(long, value_name = "ID")]
    pub charger: ChargerId,
    /// Wait for the tour of this departure and no other
    #[arg(long, value_name = "ID")]
    pub departure: Option<DepartureId>,
    /// How long to wait for the plan
    #[arg(long, value_name = "SPAN", default_value = "10s")]
    pub wait: Span,
    #[command(flatten)]
    common: Common,
}

/// The longest time that fits the header of a call's deadline.
const LONGEST: Duration = Duration::from_secs(99_999_999);

/// Runs a command.
pub async fn run(Command::Get(args): Command) -> Result<(), Failure> {
    let message = GetNextRequest {
        network_id: args.network.into(),
        charger_id: args.charger.into(),
        departure_id: args.departure.map(|id| id.to_string()).unwrap_or_default(),
    };
    let channel = args.common.remote.connect().await?;
    let mut client = TourServiceClient::new(channel).max_decoding_message_size(MESSAGE_BYTES);
    let tour = client.get_next(waiting(message, args.wait.0.min(LONGEST))).await;
    let tour = wire::tour(tour.map_err(refused)?.into_inner()).map_err(unreadable)?;
    show::item(args.common.json, &tour, show::tour)
}
