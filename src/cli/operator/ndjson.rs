//! Requests from a file, one JSON object a line, over one stream.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;

use super::arguments::fresh_id;
use super::client::{refused, unreadable};
use super::remote::Service;
use super::show;
use crate::cli::{Failure, input, say};
use crate::domain::{ClientId, NetworkId, NewRequest, Place, Request, SensorId};
use crate::grpc::wire;
use crate::proto::acknowledgement::Result as Outcome;
use crate::proto::request_service_client::RequestServiceClient;
use crate::proto::{Acknowledgement, SubmitRequest};

/// The longest line.
const LINE_BYTES: u64 = 1024 * 1024;
/// Lines that are read ahead of the stream.
const AHEAD: usize = 256;

/// A line of the file: a request, with the ids that the command line can stand in for.
#[derive(Debug, Deserialize)]
struct Line {
    client_id: Option<ClientId>,
    network_id: Option<NetworkId>,
    sensor_id: SensorId,
    place: Option<Place>,
    deadline: Option<Timestamp>,
    ready: Option<Timestamp>,
    residual_j: Option<f64>,
    measured_at: Option<Timestamp>,
    drain_w: Option<f64>,
    reward: Option<f64>,
    #[serde(default)]
    required: bool,
}

/// What `--json` prints of an acknowledgement.
#[derive(Serialize)]
struct Shown<'a> {
    position: u64,
    client_id: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    request: Option<&'a Request>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<&'a str>,
}

/// Submits the lines of a file; what is refused is told and does not stop the others.
pub async fn submit(
    mut client: RequestServiceClient<Service>,
    file: PathBuf,
    network: Option<NetworkId>,
    json: bool,
) -> Result<(), Failure> {
    let (sender, receiver) = mpsc::channel(AHEAD);
    let reading = tokio::task::spawn_blocking(move || read(&file, network, &sender));
    let stream = client.submit_stream(ReceiverStream::new(receiver)).await.map_err(refused)?;
    let mut stream = stream.into_inner();
    let (mut stored, mut lines) = (0_u64, Vec::new());
    while let Some(acknowledgement) = stream.message().await.map_err(refused)? {
        match show_one(acknowledgement, json)? {
            None => stored += 1,
            // Of thousands the first few say it all.
            Some(line) if lines.len() < 20 => lines.push(line),
            Some(_) => {}
        }
    }
    if !json {
        say(format!("{stored} requests stored"));
    }
    let read = reading.await.map_err(|error| Failure::other(error.to_string()))?;
    if let Err(failure) = read {
        lines.extend(failure.lines);
    }
    if lines.is_empty() { Ok(()) } else { Err(Failure { code: 2, lines }) }
}

/// Prints one acknowledgement; the line to tell where it is a refusal.
fn show_one(wire: Acknowledgement, json: bool) -> Result<Option<String>, Failure> {
    let Acknowledgement { position, client_id, result } = wire;
    let (request, refused) = match result {
        Some(Outcome::Request(request)) => {
            (Some(wire::request(request).map_err(unreadable)?), None)
        }
        Some(Outcome::Refused(refusal)) => {
            let fields = refusal.field_violations.iter();
            let fields: Vec<_> =
                fields.map(|v| format!("{}: {}", v.field, v.description)).collect();
            let why = if fields.is_empty() { refusal.message } else { fields.join("; ") };
            (None, Some(why))
        }
        None => (None, Some("an acknowledgement without a result".to_owned())),
    };
    if json {
        let refused = refused.as_deref();
        let shown = Shown { position, client_id: &client_id, request: request.as_ref(), refused };
        show::item(true, &shown, |_| String::new())?;
    }
    Ok(refused.map(|why| format!("request {} ({}): {why}", position + 1, show::free(client_id))))
}

fn read(
    file: &Path,
    network: Option<NetworkId>,
    sender: &mpsc::Sender<SubmitRequest>,
) -> Result<(), Failure> {
    if file == Path::new("-") {
        return lines(file, io::stdin().lock(), network.as_ref(), sender);
    }
    let opened =
        File::open(file).map_err(|error| Failure::input(format!("{}: {error}", file.display())))?;
    lines(file, BufReader::new(opened), network.as_ref(), sender)
}

fn lines(
    file: &Path,
    mut reader: impl BufRead,
    network: Option<&NetworkId>,
    sender: &mpsc::Sender<SubmitRequest>,
) -> Result<(), Failure> {
    let mut text = Vec::new();
    for number in 1_u64.. {
        let bad = |why: String| {
            let before = "those before it were submitted";
            Failure::input(format!("{} line {number}: {why}; {before}", file.display()))
        };
        text.clear();
        let read = (&mut reader).take(LINE_BYTES).read_until(b'\n', &mut text);
        if read.map_err(|error| bad(error.to_string()))? == 0 {
            break;
        }
        if text.len() as u64 == LINE_BYTES {
            return Err(bad(format!("has more than {LINE_BYTES} bytes")));
        }
        if text.trim_ascii().is_empty() {
            continue;
        }
        let message = parse(&text, network).map_err(bad)?;
        if sender.blocking_send(message).is_err() {
            break; // The stream has ended, and says why itself.
        }
    }
    Ok(())
}

fn parse(text: &[u8], network: Option<&NetworkId>) -> Result<SubmitRequest, String> {
    let value = serde_json::from_slice(text).map_err(|error| error.to_string())?;
    let line: Line = input::strict(value)?;
    let network_id = line.network_id.or_else(|| network.cloned());
    let client_id = match line.client_id {
        Some(id) => id,
        None => fresh_id().map_err(|failure| failure.lines.join("; "))?,
    };
    let asked = NewRequest {
        network_id: network_id.ok_or("network_id: is missing, and so is --network")?,
        sensor_id: line.sensor_id,
        place: line.place,
        deadline: line.deadline,
        ready: line.ready,
        residual_j: line.residual_j,
        measured_at: line.measured_at,
        drain_w: line.drain_w,
        reward: line.reward,
        required: line.required,
    };
    Ok(wire::new_request_to_wire(&client_id, asked))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_may_leave_the_network_to_the_command_line() {
        let north: NetworkId = "north".parse().unwrap();
        let wire = parse(br#"{"sensor_id": "s1", "residual_j": 5}"#, Some(&north)).unwrap();
        assert_eq!((wire.network_id.as_str(), wire.residual_j), ("north", Some(5.0)));
        assert!(parse(br#"{"sensor_id": "s1"}"#, None).unwrap_err().contains("--network"));
    }

    #[test]
    fn unknown_fields_are_refused() {
        let error = parse(br#"{"sensor_id": "s1", "dedline": 5}"#, None).unwrap_err();
        assert_eq!(error, "dedline: is no field");
    }
}
