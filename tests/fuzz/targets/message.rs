//! A gRPC message of any method: answered, or refused with a status that says whose fault it is.
//!
//! The bytes are the name of a method as in `Request/Submit`, a line's end, and the message.

use axum::http::uri::PathAndQuery;
use tonic::client::Grpc;
use tonic::{Code, Request, Status};

use super::raw::Raw;
use super::service::Service;

/// Longer messages are refused for their length; time is for many messages.
const LONGEST: usize = 64 * 1024;

pub fn message(data: &[u8]) -> bool {
    let Some((name, message)) = split(data) else { return false };
    let Some((service, method)) = name.split_once('/') else { return false };
    let path = format!("/voltour.v1.{service}Service/{method}");
    let Ok(path) = path.parse::<PathAndQuery>() else { return false };
    let running = Service::running();
    match running.wait(call(running, path, message.to_vec(), method == "Watch")) {
        Ok(()) => true,
        Err(status) => {
            assert!(is_callers_fault(&status), "{name}: {status:?}");
            was_read(&status)
        }
    }
}

/// The name and the message; none where there is no name in which something could be called.
fn split(data: &[u8]) -> Option<(&str, &[u8])> {
    let end = data.iter().take(64).position(|byte| *byte == b'\n')?;
    let (name, message) = (&data[..end], &data[end + 1..]);
    let is_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'/';
    let is_good = name.iter().all(is_name) && message.len() <= LONGEST;
    is_good.then_some((std::str::from_utf8(name).ok()?, message))
}

/// Sends one message, as a stream of one, which is the same on the wire; reads what comes back unless it is a watch,
/// which does not end.
async fn call(
    to: &Service,
    path: PathAndQuery,
    message: Vec<u8>,
    is_watch: bool,
) -> Result<(), Status> {
    let mut client = Grpc::new(to.channel.clone());
    client.ready().await.map_err(|error| Status::internal(error.to_string()))?;
    let items = Request::new(tokio_stream::once(message));
    let mut answers = client.streaming(items, path, Raw).await?.into_inner();
    if is_watch {
        return Ok(());
    }
    while answers.message().await?.is_some() {}
    Ok(())
}

/// What is not there, or not there in time, was asked for well.
fn was_read(status: &Status) -> bool {
    use Code::{AlreadyExists, DeadlineExceeded, FailedPrecondition, NotFound};
    matches!(status.code(), NotFound | FailedPrecondition | AlreadyExists | DeadlineExceeded)
}

fn is_callers_fault(status: &Status) -> bool {
    match status.code() {
        // The library's word for bytes that are no message.
        Code::Internal => status.message().contains("failed to decode Protobuf message"),
        Code::Unknown | Code::DataLoss | Code::Unavailable => false,
        _ => true,
    }
}
