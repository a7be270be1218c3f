//! No more connections at once than allowed; further ones wait in the system's queue.

use std::fmt;
use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use futures_util::stream::{self, Stream};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::JoinSet;
use tokio_rustls::TlsAcceptor;
use tokio_util::either::Either;
use tokio_util::sync::CancellationToken;

use super::connection::{Connection, Place, Transport};
use super::opening::Opening;
use crate::metrics::Level;

/// After a failed accept (out of file descriptors, say) so long is waited for some to be closed.
const AGAIN: Duration = Duration::from_millis(100);

/// A client has so long to shake hands.
const HANDSHAKE: Duration = Duration::from_secs(10);

/// A listener that counts its connections.
pub struct Counted {
    listener: TcpListener,
    room: Arc<Semaphore>,
    patience: Duration,
    open: Level,
    tls: Option<TlsAcceptor>,
    /// Cancelled, who has not said yet what HTTP/2 begins with loses the connection.
    preface: Option<CancellationToken>,
    /// Each holds its place among the connections: there are no more of them than of these.
    handshakes: JoinSet<Option<(Connection, SocketAddr)>>,
}

impl fmt::Debug for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Counted").field("listener", &self.listener).finish_non_exhaustive()
    }
}

impl Counted {
    /// At most so many connections at once, with TLS if there is an acceptor. A client has `patience` to take what is
    /// sent to it.
    pub fn new(
        listener: TcpListener,
        connections: usize,
        patience: Duration,
        open: Level,
        tls: Option<TlsAcceptor>,
    ) -> Self {
        let room = Arc::new(Semaphore::new(connections));
        let handshakes = JoinSet::new();
        Self { listener, room, patience, open, tls, preface: None, handshakes }
    }

    /// For HTTP/2, whose clients have `patience` for what each begins with, too, and no longer than until `stop`.
    pub fn with_preface(self, stop: CancellationToken) -> Self {
        Self { preface: Some(stop), ..self }
    }

    /// From the streams of clients to their connections.
    fn opened(&self) -> impl FnOnce(Transport, Place) -> Connection + Send + use<> {
        let (patience, preface) = (self.patience, self.preface.clone());
        move |stream, place| {
            let opening = preface.map(|stop| Opening::new(patience, stop));
            Connection::new(stream, patience, opening, place)
        }
    }

    /// The next connection.
    pub async fn next(&mut self) -> (Connection, SocketAddr) {
        loop {
            let (stream, permit, peer) = tokio::select! {
                accepted = accept(&self.listener, &self.room) => accepted,
                Some(shaken) = self.handshakes.join_next() => match shaken {
                    Ok(Some(ready)) => return ready,
                    _ => continue,
                },
            };
            let (place, opened) = (Place::new(permit, self.open.enter()), self.opened());
            let Some(tls) = self.tls.clone() else {
                return (opened(Either::Left(stream), place), peer);
            };
            // Beside the others: who is slow at it holds up nobody else.
            self.handshakes.spawn(async move {
                match tokio::time::timeout(HANDSHAKE, tls.accept(stream)).await {
                    Ok(Ok(stream)) => {
                        return Some((opened(Either::Right(Box::new(stream)), place), peer));
                    }
                    Ok(Err(error)) => tracing::debug!(%peer, %error, "no TLS with a client"),
                    Err(_) => tracing::debug!(%peer, "no TLS with a client in time"),
                }
                None
            });
        }
    }
}

async fn accept(
    listener: &TcpListener,
    room: &Arc<Semaphore>,
) -> (TcpStream, Option<OwnedSemaphorePermit>, SocketAddr) {
    loop {
        // The semaphore is never closed; without a permit the connection would merely be uncounted.
        let permit = room.clone().acquire_owned().await.ok();
        match listener.accept().await {
            Ok((stream, peer)) => {
                // Small answers must not wait for more to send; where that fails they do.
                let _ = stream.set_nodelay(true);
                return (stream, permit, peer);
            }
            Err(error) => {
                tracing::warn!(%error, "a connection was not accepted");
                tokio::time::sleep(AGAIN).await;
            }
        }
    }
}

/// The connections of a listener, for tonic.
pub fn incoming(listener: Counted) -> impl Stream<Item = io::Result<Connection>> {
    stream::unfold(listener, |mut listener| async {
        let (connection, _) = listener.next().await;
        Some((Ok(connection), listener))
    })
}
