//! Around every call: bounds how many there are, and counts each by its method and by the code that it ended with,
//! which comes with the headers of the answer, with its trailers, or, where the client went away, never.

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use axum::http::{HeaderMap, Request, Response};
use http_body::{Frame, SizeHint};
use prost::bytes::Bytes;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tonic::body::Body;
use tonic::codegen::Service;
use tonic::{Code, Status};

use super::Limits;
use super::status::too_long;
use crate::access::table::{self, Who};
use crate::domain::Refusal;
use crate::metrics::{Calls, GrpcCall};

/// Anybody may call it, and it lasts for as long as its caller likes.
const HEALTH_WATCH: &str = "/grpc.health.v1.Health/Watch";
/// Watches of the health service at once, which have room of their own.
pub(super) const HEALTH_WATCHES: usize = 100;

/// Room for calls, over all connections.
#[derive(Clone, Debug)]
pub(super) struct Room {
    calls: Arc<Semaphore>,
    most: usize,
    health_watches: Arc<Semaphore>,
}

impl Room {
    /// For at most so many calls, but for health checks.
    pub fn new(most: usize) -> Self {
        let room = |places| Arc::new(Semaphore::new(places));
        Self { calls: room(most), most, health_watches: room(HEALTH_WATCHES) }
    }

    /// Room for one more call. Those that ask once whether the service lives need none: they are answered at once.
    fn permit(&self, path: &str) -> Result<Option<OwnedSemaphorePermit>, Refusal> {
        let (room, limit, reason) = if path == HEALTH_WATCH {
            let reason = format!("{HEALTH_WATCHES} health watches are open, the most at once");
            (&self.health_watches, "health watches", reason)
        } else if table::grpc(path) == Some(Who::Anybody) {
            return Ok(None);
        } else {
            let reason = format!("{} calls are being answered, the most at once", self.most);
            (&self.calls, "limits.all_calls", reason)
        };
        let permit = room.clone().try_acquire_owned();
        permit.map(Some).map_err(|_| Refusal::exhausted(limit, reason))
    }
}

/// The layer.
#[derive(Clone, Debug)]
pub(super) struct Count<S> {
    inner: S,
    calls: Calls,
    limits: Limits,
    room: Room,
}

impl<S> Count<S> {
    /// `room` is that for all calls.
    pub fn new(inner: S, calls: Calls, limits: Limits, room: Room) -> Self {
        Self { inner, calls, limits, room }
    }
}

impl<S> Service<Request<Body>> for Count<S>
where
    S: Service<Request<Body>, Response = Response<Body>, Future: Send + 'static>,
{
    type Response = Response<Body>;
    type Error = S::Error;
    type Future = Pin<Box<dyn Future<Output = Result<Response<Body>, S::Error>> + Send>>;

    fn poll_ready(&mut self, cx: &mut Context<'_>) -> Poll<Result<(), S::Error>> {
        self.inner.poll_ready(cx)
    }

    fn call(&mut self, call: Request<Body>) -> Self::Future {
        let path = call.uri().path();
        let (mut counted, permit) = (self.calls.grpc(path), self.room.permit(path));
        let permit = match permit {
            Ok(permit) => permit,
            Err(refusal) => {
                counted.ended(Code::ResourceExhausted);
                return Box::pin(async { Ok(Status::from(refusal).into_http()) });
            }
        };
        let (answer, most) = (self.inner.call(call), self.limits.message_bytes);
        Box::pin(async move {
            let mut answer = answer.await?;
            if code(answer.headers()) == Some(Code::OutOfRange) {
                let status = Status::out_of_range("");
                answer = too_long(status, most).into_http();
            }
            match code(answer.headers()) {
                Some(code) => {
                    counted.ended(code);
                    Ok(answer)
                }
                None => Ok(answer.map(|inner| {
                    Body::new(Counted { inner, call: Some(counted), _permit: permit })
                })),
            }
        })
    }
}

/// The body of an answer, whose end is the call's.
struct Counted {
    inner: Body,
    call: Option<GrpcCall>,
    _permit: Option<OwnedSemaphorePermit>,
}

impl http_body::Body for Counted {
    type Data = Bytes;
    type Error = Status;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Status>>> {
        let polled = Pin::new(&mut self.inner).poll_frame(cx);
        let code = match &polled {
            Poll::Ready(Some(Ok(frame))) => frame.trailers_ref().and_then(code),
            Poll::Ready(Some(Err(status))) => Some(status.code()),
            _ => None,
        };
        if let Some(code) = code
            && let Some(mut call) = self.call.take()
        {
            call.ended(code);
        }
        polled
    }

    fn is_end_stream(&self) -> bool {
        self.inner.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.inner.size_hint()
    }
}

/// The code that headers or trailers tell.
fn code(headers: &HeaderMap) -> Option<Code> {
    headers.get("grpc-status").map(|code| Code::from_bytes(code.as_bytes()))
}
