//! `voltour serve`: runs the service until it is told to stop.

use std::future::Future;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Builder;
use tokio::signal::unix::{SignalKind, signal};

use super::{Failure, say};
use crate::app::{App, AppError};
use crate::clock::SystemClock;
use crate::config::{self, Config, Setting};
use crate::lifecycle::Lifecycle;
use crate::telemetry::{LogFilter, Telemetry};
use crate::{demo, telemetry};

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_long_help = HELP)]
pub struct Args {
    /// TOML file with the configuration; every key has a default
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Set a key of the configuration, over the file and the environment; may be repeated
    #[arg(long, value_name = "SECTION.KEY=VALUE", conflicts_with = "demo")]
    pub set: Vec<Setting>,
    /// Play a base station and a charger against the service, in fast motion
    #[arg(long)]
    pub demo: bool,
    /// With --demo: stop after so many departures instead of at Ctrl-C
    #[arg(long, value_name = "N", requires = "demo", value_parser = clap::value_parser!(u32).range(1..))]
    pub demo_departures: Option<u32>,
}

const HELP: &str = "\
When it is ready it prints one line to standard output,
  voltour ready grpc=http://127.0.0.1:7440 rest=http://127.0.0.1:7480
and logs to standard error from then on. SIGTERM or Ctrl-C ends it gently, a second one at once. SIGHUP loads the
trained policies again; one that does not pass its checks is refused, and that from before stays in use.

Configuration, as TOML (these are the defaults):
  [grpc]
  listen = \"127.0.0.1:7440\"    # loopback only as long as there is no token; port 0 takes a free one
  [rest]
  listen = \"127.0.0.1:7480\"
  hosts = []                   # names beside localhost that are answered to on a loopback address
  [tls]                        # of both ports; PEM
  # certificate_file = \"voltour.crt\"
  # key_file = \"voltour.key\"
  # client_ca_file = \"clients.crt\"  # only clients with a certificate of this authority
  [access]
  # bootstrap_token_file = \"token\"  # an admin's token for all networks
  [store]
  path = \"voltour.db\"          # made where there is none
  [retention]
  # history = \"90d\"            # left out, everything is kept for good
  [planning]
  solver = \"auto\"
  budget = \"2s\"                # time that the search for a tour may take
  explanation_budget = \"2s\"    # time to say why a plan is as it is, after its tour is out; 0s for never
  # lead = \"3s\"                # a batch closes so long before its departure; budget + 1 s
  max_late = \"10m\"             # a departure that would be later is missed
  overdue_after = \"30m\"        # silence after the planned finish
  seed = 0
  threads = 1
  [policy]
  # folder = \"models\"          # k_coverage.onnx, reward.onnx, mobile.onnx in place of those in the binary
  [limits]
  message_bytes = 4194304
  connections = 1000
  calls = 1000                 # at once on one connection
  streams = 256                # watches and submission streams
  unacknowledged = 1000        # of one submission stream
  all_calls = 10000            # gRPC, over all connections
  waits = 1000                 # calls that wait for a tour
  rest_calls = 64
  longest_wait = \"5m\"
  slow_client = \"30s\"        # to ask, or to take what is sent
  networks = 1000
  departures = 1000            # of a network, that wait for their plan
  [lifecycle]
  stop_within = \"10s\"
  [log]
  format = \"text\"              # or json
  filter = \"info\"
  [telemetry]
  # otlp_endpoint = \"http://localhost:4317\"  # spans, to an OpenTelemetry collector
  sample_ratio = 1.0

The environment goes before the file: VOLTOUR_PLANNING__BUDGET=1s, VOLTOUR_LOG__FORMAT=json. The command line goes
before both: --set planning.budget=1s. `voltour config check` and `config print` say what comes of it.

Who may do what: as long as there is no token, everybody who reaches the service, which is why it listens on
loopback only. From the first token on (`voltour token create`, or an admin's in VOLTOUR_ACCESS__BOOTSTRAP_TOKEN or
in access.bootstrap_token_file) every call needs one, but for those that ask whether the service lives.

The demonstration (--demo) takes free ports where the usual ones are taken, and keeps its database in
a temporary directory unless --config is given.";

/// What still runs when the service has ended is given so long.
const LAST: Duration = Duration::from_secs(1);

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let config = config::load_with(args.config.as_deref(), &args.set)
        .map_err(|errors| Failure { code: 2, lines: errors.0 })?;
    if args.demo {
        // Its lines are the demonstration; of the log only what goes wrong.
        let log = config::Log { filter: "warn".to_owned(), ..config.log.clone() };
        let log = if args.config.is_some() { config.log.clone() } else { log };
        let telemetry = begin(&log, &config::Telemetry::default())?;
        let configured = args.config.is_some().then_some(config);
        return block_on(demo::run(configured, args.demo_departures, telemetry.filter));
    }
    block_on(async {
        let telemetry = begin(&config.log, &config.telemetry)?;
        let served = serve(config, telemetry.filter.clone()).await;
        telemetry.end().await;
        served
    })
}

fn begin(log: &config::Log, spans: &config::Telemetry) -> Result<Telemetry, Failure> {
    telemetry::init(log, spans).map_err(|error| Failure::input(error.to_string()))
}

async fn serve(config: Config, log: LogFilter) -> Result<(), Failure> {
    let lifecycle = Lifecycle::default();
    let failed = |error: &dyn std::error::Error| Failure::other(error.to_string());
    lifecycle.listen().map_err(|error| failed(&error))?;
    // Before the start, which may take long: a SIGHUP that nobody listens for ends the process.
    let hangups = signal(SignalKind::hangup()).map_err(|error| failed(&error))?;
    let hard = lifecycle.hard.clone();
    let started = tokio::select! {
        started = App::start(&config, Arc::new(SystemClock), lifecycle, log) => started,
        () = hard.cancelled() => Err(AppError::Hard),
    };
    let app = started.map_err(not_started)?;
    app.reload_on(hangups);
    say(app.ready());
    app.run().await.map_err(|error| failed(&error))
}

/// Why the service did not start.
pub(crate) fn not_started(error: AppError) -> Failure {
    let line = error.to_string();
    if error.is_input() { Failure::input(line) } else { Failure::other(line) }
}

/// Runs a future on a runtime of its own, to an exit code.
pub(super) fn block_on(
    future: impl Future<Output = Result<(), Failure>>,
) -> Result<ExitCode, Failure> {
    let runtime = Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| Failure::other(format!("no runtime: {error}")))?;
    let ended = runtime.block_on(future);
    runtime.shutdown_timeout(LAST);
    ended.map(|()| ExitCode::SUCCESS)
}
