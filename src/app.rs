//! The service as a whole: starts its parts in order, and ends them in the opposite one.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::signal::unix::Signal;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;

use crate::access::{Gate, Secret};
use crate::clock::Clock;
use crate::config::{Config, ConfigError};
use crate::explainer::Explainer;
use crate::grpc::{Edge, Server, ServerError};
use crate::lifecycle::Lifecycle;
use crate::listen::Counted;
use crate::metrics::Metrics;
use crate::policy::{self, Shelf};
use crate::rest::{self, Guard, RestState};
use crate::retention::Retention;
use crate::scheduler::{self, Running};
use crate::store::{Store, StoreError};
use crate::telemetry::LogFilter;
use crate::tls::{Tls, TlsError};

/// Why the service did not start, or did not end well.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The database cannot be opened.
    #[error("store.path {path:?}: {source}")]
    Open {
        /// As it was configured.
        path: String,
        /// What is wrong with it.
        source: StoreError,
    },
    /// The configuration names something that is not as it should be.
    #[error("{0}")]
    Config(#[from] ConfigError),
    /// The certificates are no good.
    #[error("{0}")]
    Tls(#[from] TlsError),
    /// Whoever reaches the service could do everything.
    #[error(
        "{key}: {address} must be a loopback address, such as 127.0.0.1 or [::1], as long as there is no token, \
         for whoever reaches the service could do everything; make a token (voltour token create NAME --role admin \
         --all-networks --database {path:?}), or give one (VOLTOUR_ACCESS__BOOTSTRAP_TOKEN, or the file \
         access.bootstrap_token_file)"
    )]
    Exposed {
        /// The configuration's key.
        key: &'static str,
        /// Its value.
        address: SocketAddr,
        /// The database.
        path: String,
    },
    /// The address is taken, say.
    #[error("{key}: {address} cannot be listened on: {source}")]
    Listen {
        /// The configuration's key.
        key: &'static str,
        /// Its value.
        address: SocketAddr,
        /// What the system says.
        source: io::Error,
    },
    /// The database failed for good.
    #[error("the database cannot be written any more: {0}")]
    Store(#[from] StoreError),
    /// The gRPC server failed.
    #[error("grpc: {0}")]
    Grpc(#[from] ServerError),
    /// A task died.
    #[error("a server died: {0}")]
    Died(#[from] tokio::task::JoinError),
    /// Not everything ended in time, or a second signal came.
    #[error("stopped before everything had ended; what was acknowledged is stored")]
    Hard,
}

impl AppError {
    /// Whether the configuration is to blame.
    pub fn is_input(&self) -> bool {
        matches!(self, Self::Config(_) | Self::Tls(_) | Self::Exposed { .. })
    }
}

/// The running service.
#[derive(Debug)]
pub struct App {
    /// Where gRPC is served.
    pub grpc: SocketAddr,
    /// Where REST is served.
    pub rest: SocketAddr,
    /// What both are called with: `http` or `https`.
    pub scheme: &'static str,
    policies: Shelf,
    metrics: Metrics,
    lifecycle: Lifecycle,
    stop_within: Duration,
    servers: [JoinHandle<Result<(), AppError>>; 2],
    explainer: JoinHandle<()>,
    running: Running,
    scheduler: CancellationToken,
}

impl App {
    /// Loads the policies; starts the store, the scheduler, the listeners and the explainer, in this order. It answers when it returns.
    ///
    /// # Errors
    /// One of them did not start; those before it have ended again.
    pub async fn start(
        config: &Config,
        clock: Arc<dyn Clock>,
        lifecycle: Lifecycle,
        log: LogFilter,
    ) -> Result<Self, AppError> {
        let (bootstrap, tls) = (config.bootstrap()?, Tls::open(&config.tls)?);
        let folder = config.policy.folder.clone();
        let policies = tokio::task::spawn_blocking(move || Shelf::open(folder.as_deref())).await?;
        let path = &config.store.path;
        let opened = Store::open(path, clock.clone()).await;
        let store =
            opened.map_err(|source| AppError::Open { path: path.display().to_string(), source })?;
        let gate = match guarded(config, &store, bootstrap.as_ref()).await {
            Ok(gate) => gate,
            Err(error) => {
                store.close().await?;
                return Err(error);
            }
        };
        let cancel = CancellationToken::new();
        let mut settings = config.settings();
        settings.planner_threads = planner_threads(settings.planner_threads);
        let (reads, writer) = (store.reads.clone(), store.writer.clone());
        let metrics = Metrics::new(clock.clone(), writer.metrics());
        let retained = writer.clone();
        let (shelf, counted, scheduled) = (policies.clone(), metrics.clone(), cancel.clone());
        let starting = scheduler::start(store, clock.clone(), settings, shelf, counted, scheduled);
        let (handle, running) = starting.await?;
        let listening = async {
            let grpc = listen("grpc.listen", config.grpc.listen).await?;
            let rest = listen("rest.listen", config.rest.listen).await?;
            Ok::<_, AppError>((grpc, rest))
        };
        let ((grpc, grpc_at), (rest, rest_at)) = match listening.await {
            Ok(listeners) => listeners,
            Err(error) => {
                cancel.cancel();
                running.finished().await?;
                return Err(error);
            }
        };
        let soft = lifecycle.soft.clone();
        let acceptor = |protocol| tls.as_ref().map(|tls| tls.acceptor(protocol));
        let counted = |listener, protocol| {
            let edge = if protocol == "h2" { "grpc" } else { "rest" };
            let open = metrics.calls.connections(edge);
            let limits = &config.limits;
            let slow = limits.slow_client.0;
            Counted::new(listener, limits.connections, slow, open, acceptor(protocol))
        };
        let grpc = counted(grpc, "h2").with_preface(soft.clone());
        let rest = counted(rest, "http/1.1");
        let (limits, calls) = (config.grpc_limits(), metrics.calls.clone());
        let edge = Edge::new(handle.clone(), gate.clone(), limits, calls, soft.clone());
        let guard = Guard::new(
            gate.clone(),
            rest_at.ip().is_loopback(),
            &config.rest.hosts,
            config.limits.rest_calls,
        );
        let state = RestState::new(handle.reads().clone(), metrics.clone(), log, soft.clone());
        tokio::spawn(gate.follow(soft.clone()));
        let slow = config.limits.slow_client.0;
        let servers = [
            tokio::spawn(async move { Ok(Server::new(edge, grpc).run().await?) }),
            tokio::spawn(async move {
                rest::serve(rest, rest::router(state, guard), slow, soft).await;
                Ok(())
            }),
        ];
        let soft = lifecycle.soft.clone();
        if let Some(history) = config.retention.history {
            let retention = Retention::new(retained, clock.clone(), history.0, soft.clone());
            tokio::spawn(retention.run());
        }
        let counted = metrics.clone();
        let explainer = Explainer::new(reads, writer, clock, config.explainer(), counted, soft);
        Ok(Self {
            grpc: grpc_at,
            rest: rest_at,
            scheme: if tls.is_some() { "https" } else { "http" },
            policies,
            metrics,
            lifecycle,
            stop_within: config.lifecycle.stop_within.0,
            servers,
            explainer: tokio::spawn(explainer.run()),
            running,
            scheduler: cancel,
        })
    }

    /// The line that says where it answers.
    pub fn ready(&self) -> String {
        let Self { scheme, grpc, rest, .. } = self;
        format!("voltour ready grpc={scheme}://{grpc} rest={scheme}://{rest}")
    }

    /// Loads the policies again at every SIGHUP, also at those that came while it was started.
    pub fn reload_on(&self, hangups: Signal) {
        let (metrics, soft) = (self.metrics.clone(), self.lifecycle.soft.clone());
        policy::reload_on(hangups, self.policies.clone(), soft, move |_, became| {
            metrics.planning.policy_reloaded(became);
        });
    }

    /// Runs until the lifecycle ends it, or until one of its parts fails, which ends the others.
    ///
    /// # Errors
    /// A part failed, or not everything ended in time.
    pub async fn run(self) -> Result<(), AppError> {
        let Self { lifecycle, stop_within, servers, explainer, running, scheduler, .. } = self;
        let aborts = servers.each_ref().map(JoinHandle::abort_handle);
        let ending = async {
            let clients = stop_within / 2;
            let [grpc, rest] = servers.map(|server| watched(server, &lifecycle, clients));
            let failing = async {
                // The scheduler ends itself where the database fails for good.
                scheduler.cancelled().await;
                lifecycle.soft.cancel();
            };
            let serving = async {
                let (grpc, rest, explained) = tokio::join!(grpc, rest, explainer);
                if let Err(error) = explained {
                    tracing::error!(%error, "a defect: the explainer died");
                }
                // Only now: a call that still runs may need it.
                scheduler.cancel();
                grpc.and(rest)
            };
            let (served, ()) = tokio::join!(serving, failing);
            running.finished().await?;
            served
        };
        let ended = tokio::select! {
            ended = ending => ended,
            () = lifecycle.given_up(stop_within) => Err(AppError::Hard),
        };
        aborts.iter().for_each(tokio::task::AbortHandle::abort);
        ended
    }
}

/// The end of a server; the first that ends takes the others along. Clients that are so slow to end what they have
/// begun are left: nothing that was acknowledged depends on them.
async fn watched(
    mut server: JoinHandle<Result<(), AppError>>,
    lifecycle: &Lifecycle,
    patience: Duration,
) -> Result<(), AppError> {
    tokio::select! {
        ended = &mut server => {
            lifecycle.soft.cancel();
            ended?
        }
        () = lifecycle.late(patience) => {
            tracing::warn!(?patience, "clients are slow to end, and lose their connections");
            server.abort();
            Ok(())
        }
    }
}

/// As many as are configured, but for one core, which is left to the requests.
fn planner_threads(configured: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let most = cores.saturating_sub(1).max(1);
    if configured > most {
        tracing::warn!(configured, most, cores, "planning.threads: one core is left to requests");
    }
    configured.min(most)
}

async fn listen(
    key: &'static str,
    address: SocketAddr,
) -> Result<(TcpListener, SocketAddr), AppError> {
    let failed = |source| AppError::Listen { key, address, source };
    let listener = TcpListener::bind(address).await.map_err(failed)?;
    let at = listener.local_addr().map_err(failed)?;
    Ok((listener, at))
}

/// The gate, if the addresses that are configured may be listened on behind it.
async fn guarded(
    config: &Config,
    store: &Store,
    bootstrap: Option<&Secret>,
) -> Result<Gate, AppError> {
    let gate = Gate::open(store.reads.clone(), bootstrap).await?;
    for (key, address) in [("grpc.listen", config.grpc.listen), ("rest.listen", config.rest.listen)]
    {
        if address.ip().is_loopback() {
            continue;
        }
        if !gate.is_closed() {
            let path = config.store.path.display().to_string();
            return Err(AppError::Exposed { key, address, path });
        }
        if config.tls.certificate_file.is_none() {
            tracing::warn!(key, %address, "without TLS tokens can be read on their way; see [tls]");
        }
    }
    if gate.is_closed() {
        tracing::info!("every call needs a token, but for health checks");
    } else {
        tracing::info!("there is no token: whoever reaches the service may do everything");
    }
    Ok(gate)
}
