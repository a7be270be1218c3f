//! The stage: a service with a fast clock, the players on it, and the end of the play.

use std::collections::HashMap;
use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use super::network::draw;
use super::tell::Teller;
use super::world::World;
use super::{base_station, charger};
use crate::access::Secret;
use crate::app::App;
use crate::cli::operator::{Remote, Service};
use crate::cli::serve::not_started;
use crate::cli::{Failure, say};
use crate::clock::{Clock, ScaledClock};
use crate::config::{Config, Span};
use crate::domain::{ChargerId, NetworkId, PlanId, SensorId};
use crate::lifecycle::Lifecycle;
use crate::telemetry::LogFilter;

/// Seconds on stage in one second.
const FACTOR: u32 = 300;
/// The search's budget, off stage, where none is configured.
const BUDGET: Duration = Duration::from_millis(300);
/// What planning takes beyond the search's budget, off stage.
const SLACK: Duration = Duration::from_millis(500);

/// What the players share.
#[derive(Debug)]
pub(super) struct Play {
    pub channel: Service,
    pub clock: Arc<dyn Clock>,
    pub network: NetworkId,
    pub world: World,
    pub teller: Teller,
    rest: SocketAddr,
    full_j: HashMap<SensorId, f64>,
}

impl Play {
    /// A charger does something now.
    pub(super) fn tell(&self, charger: &ChargerId, what: &str) {
        self.teller.tell(self.clock.now(), charger.as_str(), what);
    }

    /// Capacity of a sensor's battery.
    pub(super) fn full_j(&self, sensor: &SensorId) -> f64 {
        self.full_j.get(sensor).copied().unwrap_or(f64::INFINITY)
    }

    /// Where the picture of a plan can be seen.
    pub(super) fn picture(&self, plan: PlanId) -> String {
        format!("http://{}/v1/plans/{plan}.svg", self.rest)
    }
}

/// Runs until Ctrl-C, or until so many departures are over.
///
/// # Errors
/// The service did not start, or refused what should have been right.
pub async fn run(
    config: Option<Config>,
    departures: Option<u32>,
    log: LogFilter,
) -> Result<(), Failure> {
    // Removed with all that is in it when it is dropped, after the service has ended.
    let directory = tempfile::tempdir()
        .map_err(|error| Failure::other(format!("no temporary directory: {error}")))?;
    if config.as_ref().is_some_and(|config| config.tls.certificate_file.is_some()) {
        return Err(Failure::input("tls: the demonstration is played without it"));
    }
    let config = adapted(config.unwrap_or_else(|| usual(directory.path())));
    let token = config.bootstrap().map_err(|error| Failure { code: 2, lines: error.0 })?;
    let clock: Arc<dyn Clock> = Arc::new(ScaledClock::new(f64::from(FACTOR)));
    let lifecycle = Lifecycle::default();
    let failed = |error: &dyn std::error::Error| Failure::other(error.to_string());
    lifecycle.listen().map_err(|error| failed(&error))?;
    let app = App::start(&config, clock.clone(), lifecycle.clone(), log).await;
    let app = app.map_err(not_started)?;
    say(app.ready());
    let (grpc, rest) = (app.grpc, app.rest);
    let service = tokio::spawn(app.run());
    let played = tokio::select! {
        played = perform(clock, token, grpc, rest, departures) => played,
        () = lifecycle.soft.cancelled() => Ok(()),
    };
    lifecycle.soft.cancel();
    let ended = service.await.map_err(|error| failed(&error))?;
    played.and(ended.map_err(|error| failed(&error)))
}

async fn perform(
    clock: Arc<dyn Clock>,
    token: Option<Secret>,
    grpc: SocketAddr,
    rest: SocketAddr,
    departures: Option<u32>,
) -> Result<(), Failure> {
    let (spec, world) = draw(clock.as_ref())?;
    let began = clock.now();
    // Another network each time: an earlier play on the same database may have ended in the middle.
    let network = format!("demo-{}", began.as_second());
    let bad = |error: crate::domain::IdError| Failure::other(error.to_string());
    let play = Arc::new(Play {
        channel: Remote::plain(format!("http://{grpc}"), token).connect().await?,
        network: network.parse().map_err(bad)?,
        full_j: spec.sensors.iter().map(|s| (s.id.clone(), s.battery_j)).collect(),
        world,
        teller: Teller::new(began),
        clock,
        rest,
    });
    say(format!(
        "The clock runs {FACTOR} times as fast as yours; times are hours and minutes from now."
    ));
    say(format!("History of plans: http://{rest}/v1/plans    Ctrl-C ends the demonstration."));
    base_station::register(&play, &spec).await?;
    let truck = "truck-1".parse().map_err(bad)?;
    tokio::select! {
        ended = base_station::play(play.clone()) => ended,
        ended = charger::play(play, truck, departures) => ended,
    }
}

/// The configuration where none is given: a database of its own, the usual ports where they are free.
fn usual(directory: &Path) -> Config {
    let mut config = Config::default();
    config.store.path = directory.join("demo.db");
    config.planning.budget = Span(BUDGET);
    for listen in [&mut config.grpc.listen, &mut config.rest.listen] {
        if TcpListener::bind(*listen).is_err() {
            listen.set_port(0);
        }
    }
    config
}

/// The service goes by the clock on stage: what is to last so long off stage lasts much longer there.
fn adapted(mut config: Config) -> Config {
    let planning = &mut config.planning;
    planning.lead = Some(Span((planning.budget.0 + SLACK) * FACTOR));
    planning.budget = Span(planning.budget.0 * FACTOR);
    planning.explanation_budget = Span(planning.explanation_budget.0 * FACTOR);
    planning.max_late = Span::seconds(6 * 3600);
    planning.overdue_after = Span::seconds(24 * 3600);
    config
}
