//! Many submissions on one stream, pipelined: many are with the writer at once, and their
//! acknowledgements leave in the order of the items.

use futures_util::stream::{self, Stream, StreamExt};
use tonic::{Status, Streaming};

use super::Edge;
use super::edge::Permit;
use super::status::{stopping, too_long};
use super::wire;
use crate::access::Caller;
use crate::metrics::Calls;
use crate::proto::acknowledgement::Result as Outcome;
use crate::proto::{Acknowledgement, SubmitRequest};
use crate::scheduler::Handle;

/// The acknowledgements of a stream of submissions.
///
/// Items join the writer's queue one after the other, so that the later of two requests of a sensor is
/// also the newer one (futures polled side by side would overtake each other). With `unacknowledged` of them under way no further item
/// is taken, which holds the client back through HTTP/2's flow control. Dropping it (the client is gone)
/// drops what is under way; ending the input drains it.
pub(super) fn acknowledge(
    edge: Edge,
    caller: Caller,
    items: Streaming<SubmitRequest>,
    permit: Permit,
) -> impl Stream<Item = Result<Acknowledgement, Status>> + Send {
    let Edge { handle, limits, calls, stop, .. } = edge;
    let stopped = stop.clone();
    let last = stream::once(async move { stopped.is_cancelled().then(|| Err(stopping())) });
    items
        .take_until(stop.cancelled_owned())
        .enumerate()
        .then(move |(position, item)| {
            let most = limits.message_bytes;
            queue(handle.clone(), caller.clone(), calls.clone(), most, position as u64, item)
        })
        .buffered(limits.unacknowledged)
        .chain(last.filter_map(std::future::ready))
        .inspect(move |_| {
            // Held for as long as the stream lives.
            let _ = &permit;
        })
}

/// Queues an item; what it returns is its acknowledgement.
async fn queue(
    handle: Handle,
    caller: Caller,
    calls: Calls,
    most: usize,
    position: u64,
    item: Result<SubmitRequest, Status>,
) -> impl Future<Output = Result<Acknowledgement, Status>> + Send {
    let queued = match item {
        Ok(item) => {
            // Names the item also where it is refused, with no more of it than an id may have.
            let client_id = item.client_id.chars().take(64).collect();
            let answer = match wire::new_request(item) {
                Ok(call) => match caller.network(&call.content.network_id) {
                    Ok(()) => handle.queue_submit(call).await,
                    Err(refusal) => Err(refusal),
                },
                Err(refusal) => Err(refusal),
            };
            Ok((client_id, answer))
        }
        // A broken transport or an undecodable message ends the stream: what follows cannot be read.
        Err(status) => Err(too_long(status, most)),
    };
    async move {
        let (client_id, answer) = queued?;
        let submitted = match answer {
            Ok(answer) => answer.await,
            Err(refusal) => Err(refusal),
        };
        let result = match submitted {
            Ok(request) => Outcome::Request(wire::request_to_wire(request)),
            Err(refusal) => {
                calls.refused(&refusal);
                Outcome::Refused(refusal.into())
            }
        };
        Ok(Acknowledgement { position, client_id, result: Some(result) })
    }
}
