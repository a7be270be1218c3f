//! Listening: with TLS or without, and no more connections at once than allowed; further ones wait in
//! the system's queue. A client that does not take what is sent to it loses its connection.

use std::fmt;
use std::io;
use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use futures_util::stream::{self, Stream};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::JoinSet;
use tokio::time::Sleep;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;
use tokio_util::either::Either;
use tonic::transport::server::{Connected, TcpConnectInfo};

use crate::metrics::{Entered, Level};

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
        Self { listener, room, patience, open, tls, handshakes: JoinSet::new() }
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
            let place = Place { _permit: permit, _open: self.open.enter() };
            let Some(tls) = self.tls.clone() else {
                return (Connection::new(Either::Left(stream), self.patience, place), peer);
            };
            let patience = self.patience;
            // Beside the others: who is slow at it holds up nobody else.
            self.handshakes.spawn(async move {
                match tokio::time::timeout(HANDSHAKE, tls.accept(stream)).await {
                    Ok(Ok(stream)) => {
                        let stream = Either::Right(Box::new(stream));
                        return Some((Connection::new(stream, patience, place), peer));
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

/// A connection that is counted until it is dropped.
pub struct Connection {
    stream: Transport,
    patience: Duration,
    /// Since when the client takes nothing more.
    stalled: Option<Pin<Box<Sleep>>>,
    _place: Place,
}

type Transport = Either<TcpStream, Box<TlsStream<TcpStream>>>;

impl Connection {
    fn new(stream: Transport, patience: Duration, place: Place) -> Self {
        Self { stream, patience, stalled: None, _place: place }
    }

    /// What was sent, unless the client has not taken it for too long.
    fn taken<T>(&mut self, cx: &mut Context<'_>, sent: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if sent.is_ready() {
            self.stalled = None;
            return sent;
        }
        let patience = self.patience;
        let stalled = self.stalled.get_or_insert_with(|| Box::pin(tokio::time::sleep(patience)));
        match stalled.as_mut().poll(cx) {
            Poll::Pending => Poll::Pending,
            Poll::Ready(()) => Poll::Ready(Err(io::ErrorKind::TimedOut.into())),
        }
    }
}

/// A place among the connections.
struct Place {
    _permit: Option<OwnedSemaphorePermit>,
    _open: Entered,
}

impl fmt::Debug for Connection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Connection").finish_non_exhaustive()
    }
}

impl Connected for Connection {
    type ConnectInfo = TcpConnectInfo;

    fn connect_info(&self) -> TcpConnectInfo {
        match &self.stream {
            Either::Left(stream) => stream.connect_info(),
            Either::Right(stream) => stream.get_ref().0.connect_info(),
        }
    }
}

impl AsyncRead for Connection {
    fn poll_read(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(cx, buffer)
    }
}

impl AsyncWrite for Connection {
    fn poll_write(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let sent = Pin::new(&mut self.stream).poll_write(cx, bytes);
        self.taken(cx, sent)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let sent = Pin::new(&mut self.stream).poll_write_vectored(cx, slices);
        self.taken(cx, sent)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        let sent = Pin::new(&mut self.stream).poll_flush(cx);
        self.taken(cx, sent)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        let sent = Pin::new(&mut self.stream).poll_shutdown(cx);
        self.taken(cx, sent)
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::AsyncWriteExt;

    use super::*;

    #[tokio::test]
    async fn who_does_not_take_what_is_sent_loses_the_connection_and_its_place() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let (patience, open) = (Duration::from_millis(200), Level::default());
        let mut counted = Counted::new(listener, 1, patience, open.clone(), None);
        let client = TcpStream::connect(address).await.unwrap();
        let (mut connection, _) = counted.next().await;
        assert_eq!(open.count(), 1);
        let endless = async { while connection.write_all(&[0; 65_536]).await.is_ok() {} };
        tokio::time::timeout(Duration::from_secs(30), endless).await.expect("an end");
        let refused = connection.write_all(&[0; 65_536]).await.unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::TimedOut);
        drop(connection);
        assert_eq!(open.count(), 0);
        drop(client);
    }
}
