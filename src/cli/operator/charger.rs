//! `voltour charger`.

use clap::Subcommand;

use super::arguments::{Common, fresh_id};
use super::client::{call, refused, unreadable};
use super::show;
use crate::cli::{Failure, say};
use crate::domain::{ChargerId, NetworkId};
use crate::grpc::wire;
use crate::proto::departure_service_client::DepartureServiceClient;
use crate::proto::{CancelDepartureRequest, DepartureState, ListDeparturesRequest};

/// What became of chargers.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// A charger is lost: call its tour back and its departures off, so that others can serve the requests
    Lost(Lost),
}

/// Arguments of `lost`.
#[derive(Debug, clap::Args)]
pub struct Lost {
    /// The network
    #[arg(long, value_name = "ID")]
    pub network: NetworkId,
    /// The charger
    #[arg(long, value_name = "ID")]
    pub charger: ChargerId,
    #[command(flatten)]
    common: Common,
}

/// Runs a command.
pub async fn run(Command::Lost(args): Command) -> Result<(), Failure> {
    let channel = args.common.remote.connect().await?;
    let mut client = DepartureServiceClient::new(channel);
    let states = [DepartureState::Announced, DepartureState::Closed, DepartureState::Planned];
    let (mut page_token, mut found, mut failures) = (String::new(), 0_u32, Vec::new());
    loop {
        let message = ListDeparturesRequest {
            network_id: args.network.as_str().to_owned(),
            charger_id: args.charger.as_str().to_owned(),
            states: states.map(i32::from).to_vec(),
            page_size: 500,
            page_token,
        };
        let page = client.list(call(message)).await.map_err(refused)?.into_inner();
        for departure in page.departures {
            found += 1;
            let message = CancelDepartureRequest {
                client_id: fresh_id()?.into(),
                departure_id: departure.id.clone(),
                reason: "charger lost".to_owned(),
            };
            match client.cancel(call(message)).await {
                Ok(cancelled) => {
                    let cancelled = wire::departure(cancelled.into_inner()).map_err(unreadable)?;
                    show::item(args.common.json, &cancelled, show::departure)?;
                }
                // It may just have ended by itself; the others are to be called off all the same.
                Err(status) => {
                    let lines = refused(status).lines;
                    failures.extend(lines.iter().map(|line| format!("{}: {line}", departure.id)));
                }
            }
        }
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    if found == 0 && !args.common.json {
        say(format!("charger {} has no tour out and no departure announced", args.charger));
    }
    if failures.is_empty() { Ok(()) } else { Err(Failure { code: 1, lines: failures }) }
}
