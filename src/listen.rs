//! Listening: with TLS or without, and no more connections at once than allowed; further ones wait in
//! the system's queue.

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
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;
use tokio_util::either::Either;
use tonic::transport::server::{Connected, TcpConnectInfo};

/// After a failed accept (out of file descriptors, say) so long is waited for some to be closed.
const AGAIN: Duration = Duration::from_millis(100);

/// A client has so long to shake hands.
const HANDSHAKE: Duration = Duration::from_secs(10);

/// A listener that counts its connections.
pub struct Counted {
    listener: TcpListener,
    room: Arc<Semaphore>,
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
    /// At most so many connections at once, with TLS if there is an acceptor.
    pub fn new(listener: TcpListener, connections: usize, tls: Option<TlsAcceptor>) -> Self {
        let room = Arc::new(Semaphore::new(connections));
        Self { listener, room, tls, handshakes: JoinSet::new() }
    }

    async fn next(&mut self) -> (Connection, SocketAddr) {
        loop {
            let (stream, permit, peer) = tokio::select! {
                accepted = accept(&self.listener, &self.room) => accepted,
                Some(shaken) = self.handshakes.join_next() => match shaken {
                    Ok(Some(ready)) => return ready,
                    _ => continue,
                },
            };
            let Some(tls) = self.tls.clone() else {
                return (Connection { stream: Either::Left(stream), _permit: permit }, peer);
            };
            // Beside the others: who is slow at it holds up nobody else.
            self.handshakes.spawn(async move {
                match tokio::time::timeout(HANDSHAKE, tls.accept(stream)).await {
                    Ok(Ok(stream)) => {
                        let stream = Either::Right(Box::new(stream));
                        return Some((Connection { stream, _permit: permit }, peer));
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

impl axum::serve::Listener for Counted {
    type Io = Connection;
    type Addr = SocketAddr;

    async fn accept(&mut self) -> (Connection, SocketAddr) {
        self.next().await
    }

    fn local_addr(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }
}

/// A connection that is counted until it is dropped.
pub struct Connection {
    stream: Either<TcpStream, Box<TlsStream<TcpStream>>>,
    _permit: Option<OwnedSemaphorePermit>,
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
        Pin::new(&mut self.stream).poll_write(cx, bytes)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write_vectored(cx, slices)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(cx)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(cx)
    }
}
