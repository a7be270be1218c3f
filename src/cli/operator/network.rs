//! `voltour network`.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use serde_json::Value;

use super::arguments::{Caller, Common};
use super::client::{self, call, refused, unreadable};
use super::remote::Service;
use super::show;
use crate::cli::{Failure, input};
use crate::domain::{NetworkId, NetworkSpec};
use crate::grpc::wire;
use crate::proto::network_service_client::NetworkServiceClient;
use crate::proto::{GetNetworkRequest, ListNetworksRequest, PutNetworkRequest};

/// What to do with networks.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Register a network, or store its next version
    #[command(after_long_help = EXAMPLE)]
    Put(Put),
    /// Show a network and its sensors
    Get(Get),
    /// List the networks
    List(List),
}

const EXAMPLE: &str = r#"The file is one JSON object:
{
  "id": "north",
  "objective": "min_distance",
  "charge_level": 1.0,
  "coverage": { "k": 1, "field_m": [[0, 0], [300, 0], [300, 300], [0, 300]] },
  "charger_types": [
    { "name": "truck", "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20,
      "capacity_j": null, "timespan_s": null, "start_m": [250, 250], "end_m": null }
  ],
  "sensors": [
    { "id": "s1", "place": { "position_m": [150, 150] }, "range_m": 250,
      "battery_j": 10800, "drain_w": 0.3 },
    { "id": "s2", "place": { "position_m": [90, 40] }, "range_m": 250, "battery_j": 10800 }
  ]
}
objective is min_distance, max_reward or max_count. charge_level, coverage, capacity_j, timespan_s,
end_m, range_m and drain_w may be null or left out. A sensor that moves (only without coverage) has
  "place": { "trajectory": [{ "time": "2030-01-01T00:00:00Z", "position_m": [0, 0] }, ...] }"#;

/// Arguments of `put`.
#[derive(Debug, clap::Args)]
pub struct Put {
    /// JSON file; - is standard input
    pub file: PathBuf,
    /// Refuse unless the present version is this one; 0 where there is none yet
    #[arg(long, value_name = "VERSION")]
    pub expected_version: Option<u64>,
    #[command(flatten)]
    caller: Caller,
    #[command(flatten)]
    common: Common,
}

/// Arguments of `get`.
#[derive(Debug, clap::Args)]
pub struct Get {
    /// The network
    pub id: NetworkId,
    #[command(flatten)]
    common: Common,
}

/// Arguments of `list`.
#[derive(Debug, clap::Args)]
pub struct List {
    #[command(flatten)]
    common: Common,
}

/// Runs a command.
pub async fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Put(args) => put(args).await,
        Command::Get(args) => get(args).await,
        Command::List(args) => list(args).await,
    }
}

async fn put(args: Put) -> Result<(), Failure> {
    let (id, spec) = read(&args.file)?;
    let message = PutNetworkRequest {
        client_id: args.caller.id()?.into(),
        network_id: id.into(),
        spec: Some(wire::spec_to_wire(&spec)),
        expected_version: args.expected_version,
    };
    let mut client = connect(&args.common).await?;
    let network = client.put(call(message)).await.map_err(refused)?.into_inner();
    let network = wire::network(network).map_err(unreadable)?;
    show::item(args.common.json, &network, show::network_line)
}

async fn get(args: Get) -> Result<(), Failure> {
    let mut client = connect(&args.common).await?;
    let message = GetNetworkRequest { network_id: args.id.into() };
    let network = client.get(call(message)).await.map_err(refused)?.into_inner();
    let network = wire::network(network).map_err(unreadable)?;
    show::item(args.common.json, &network, show::network)
}

async fn list(args: List) -> Result<(), Failure> {
    let mut client = connect(&args.common).await?;
    let mut page_token = String::new();
    loop {
        let message = ListNetworksRequest { page_size: 500, page_token };
        let page = client.list(call(message)).await.map_err(refused)?.into_inner();
        for network in page.networks {
            let network = wire::network(network).map_err(unreadable)?;
            show::item(args.common.json, &network, show::network_line)?;
        }
        page_token = page.next_page_token;
        if page_token.is_empty() {
            return Ok(());
        }
    }
}

async fn connect(common: &Common) -> Result<NetworkServiceClient<Service>, Failure> {
    let channel = common.remote.connect().await?;
    Ok(NetworkServiceClient::new(channel).max_decoding_message_size(client::MESSAGE_BYTES))
}

/// Reads the file: the spec, and beside its fields the id.
fn read(file: &Path) -> Result<(NetworkId, NetworkSpec), Failure> {
    let text = input::read(file)?;
    parse(&text).map_err(|line| Failure::input(format!("{}: {line}", file.display())))
}

fn parse(text: &str) -> Result<(NetworkId, NetworkSpec), String> {
    let mut value: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let id = value.as_object_mut().and_then(|object| object.remove("id"));
    let id: NetworkId = match id {
        Some(Value::String(id)) => id.parse().map_err(|error| format!("id: {error}"))?,
        Some(_) => return Err("id: must be a string".to_owned()),
        None => return Err("id: is missing".to_owned()),
    };
    Ok((id, input::strict(value)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_example_of_the_help_can_be_read() {
        let json = EXAMPLE.split_once('\n').unwrap().1;
        let json = &json[..=json.rfind("\n}").unwrap() + 1];
        let (id, spec) = parse(json).unwrap();
        assert_eq!((id.as_str(), spec.sensors.len()), ("north", 2));
    }

    #[test]
    fn bad_files_are_refused_with_the_path() {
        let cases = [
            ("{}", "id: is missing"),
            (r#"{"id": "a b"}"#, "id: \"a b\" must be"),
            (r#"{"id": "a", "objective": "fun"}"#, "objective: "),
            (
                r#"{"id": "a", "objective": "max_count", "charger_types": [], "sensors":
                    [{"id": "s", "place": {"position_m": [0, 0]}, "battery_j": 1, "batery": 2}]}"#,
                "sensors[0].batery: is no field",
            ),
            (
                r#"{"id": "a", "objective": "max_count", "charger_types": [], "sensors":
                    [{"id": "s", "place": {"position_m": [0, 0]}, "battery_j": "1"}]}"#,
                "sensors[0].battery_j: ",
            ),
        ];
        for (text, says) in cases {
            let error = parse(text).unwrap_err();
            assert!(error.starts_with(says), "{error}");
        }
    }
}
