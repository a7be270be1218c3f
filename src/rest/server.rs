//! The REST server: HTTP/1.1 on one listener. A client that is slow to ask, or silent, loses its connection.

use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio_util::sync::CancellationToken;

use crate::listen::Counted;

/// Bytes of a call's head.
const HEAD_BYTES: usize = 32 * 1024;

/// Serves until it is stopped and the calls that run then are answered. A client may take `patience` for the head of
/// a call, and be silent for so long between two.
pub async fn serve(
    mut listener: Counted,
    routes: Router,
    patience: Duration,
    stop: CancellationToken,
) {
    let connections = GracefulShutdown::new();
    // Whoever does not wait for the end of this ends the connections too.
    let cut = CancellationToken::new();
    let _cut = cut.clone().drop_guard();
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(patience).max_buf_size(HEAD_BYTES);
    loop {
        let connection = tokio::select! {
            () = stop.cancelled() => break,
            connection = listener.next() => connection.0,
        };
        let service = TowerToHyperService::new(routes.clone());
        let serving = http.serve_connection(TokioIo::new(connection), service);
        let serving = cut.clone().run_until_cancelled_owned(connections.watch(serving));
        tokio::spawn(async move {
            if let Some(Err(error)) = serving.await {
                tracing::debug!(%error, "a REST connection ended");
            }
        });
    }
    // Whoever is still to be accepted is refused by the system from now on.
    drop(listener);
    connections.shutdown().await;
}
