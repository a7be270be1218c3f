//! `kill -9` at random moments: nothing acknowledged is lost, nothing is planned twice.
//!
//! The story of a trial: a base station streams requests without a pause, three chargers announce
//! departures, fetch their tours, report and complete them. At some moment the process is killed; in what
//! it was struck is read from a copy of the database. It starts again on the same database. Whatever
//! was acknowledged must be there as it was acknowledged, what was not is tried again under the same
//! client id, and the rules of "planned once" must hold in the database itself. Five trials share a
//! database; then the chargers finish, and nothing may be left in between.
//!
//! `VOLTOUR_CRASH_TRIALS` and `VOLTOUR_CRASH_SEED` say how many and which.

pub mod aim;
pub mod charger;
mod phase;
pub mod rng;
pub mod rules;
pub mod station;
pub mod verify;

use std::env;
use std::slice;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use voltour::proto::{AnnounceRequest, NetworkSpec};

use crate::app::{Settings, TestApp};
use crate::field::{at_rest, line};
use aim::{Aim, Killed};
use charger::Charger;
use phase::Struck;
use rng::Rng;
use station::Station;

/// Trials that share a database.
const ROUND: u64 = 5;
/// Sensors of the network: enough for a search that takes its whole budget.
pub const SENSORS: usize = 120;

/// A whole number from the environment.
pub fn number(name: &str, default: u64) -> u64 {
    let set = env::var(name).ok().map(|text| text.parse().expect("a whole number"));
    set.unwrap_or(default)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn kill_9_at_random_moments() {
    let trials = number("VOLTOUR_CRASH_TRIALS", 10);
    let first = number("VOLTOUR_CRASH_SEED", 1);
    let mut struck = Struck::default();
    for round in 0..trials.div_ceil(ROUND) {
        let seeds = first + round * ROUND..first + (round * ROUND + ROUND).min(trials);
        run_round(seeds, &mut struck).await;
    }
    println!("{trials} trials: {struck}");
}

/// Names the seed of a failing trial.
struct Naming(u64);

impl Drop for Naming {
    fn drop(&mut self) {
        if thread::panicking() {
            eprintln!("failed with VOLTOUR_CRASH_SEED={} VOLTOUR_CRASH_TRIALS=1", self.0);
        }
    }
}

/// Trials on one database, and the end of everything that they began.
async fn run_round(seeds: std::ops::Range<u64>, struck: &mut Struck) {
    let naming = Naming(seeds.start);
    let settings =
        Settings { solver: "baseline", budget: "120ms", lead: "300ms", ..Settings::default() };
    let mut app = TestApp::with(settings).await;
    app.put(network()).await;
    let mut station = Station::new("station", seeds.start, Duration::from_millis(1));
    let mut chargers: Vec<_> = ["A", "B", "C"].map(|id| Charger::new(id, seeds.start)).into();
    drop(naming);
    for seed in seeds.clone() {
        let _naming = Naming(seed);
        trial(&mut app, seed, &mut station, &mut chargers, struck).await;
        app.launch().await;
        verify::acknowledged(&app, slice::from_ref(&station), &chargers).await;
        rules::hold(&app.database()).await;
    }
    let _naming = Naming(seeds.start);
    settle(&app, slice::from_mut(&mut station), &mut chargers).await;
    verify::acknowledged(&app, slice::from_ref(&station), &chargers).await;
    rules::hold(&app.database()).await;
    rules::settled(&app.database()).await;
}

/// Lets everybody work until the process is killed.
async fn trial(
    app: &mut TestApp,
    seed: u64,
    station: &mut Station,
    chargers: &mut Vec<Charger>,
    struck: &mut Struck,
) {
    let mut rng = Rng::new(seed);
    let killed = Arc::new(Killed::default());
    let (mut pouring, requests) = (station.clone(), app.requests());
    let flag = killed.clone();
    let pouring = tokio::spawn(async move {
        pouring.pour(requests, &flag).await;
        pouring
    });
    let driving = chargers.drain(..).map(|mut charger| {
        let (departures, tours, flag) = (app.departures(), app.tours(), killed.clone());
        tokio::spawn(async move {
            charger.drive(departures, tours, &flag).await;
            charger
        })
    });
    let driving: Vec<_> = driving.collect();
    let aim = Aim::draw(&mut rng);
    aim.wait(&mut rng, &killed).await;
    killed.strike();
    app.kill9();
    *station = pouring.await.expect("the base station's story");
    for charger in driving {
        chargers.push(charger.await.expect("the charger's story"));
    }
    struck.count(aim, &app.database(), station).await;
}

/// The chargers finish what they are at, the base stations get their answers.
pub async fn settle(app: &TestApp, stations: &mut [Station], chargers: &mut [Charger]) {
    for station in stations {
        station.finish(app.requests()).await;
    }
    for charger in chargers.iter_mut() {
        charger.finish(app.departures(), app.tours()).await;
    }
    // One more departure shows that the queue moves.
    let last = AnnounceRequest { charger_id: "last".into(), ..crate::field::departure("last") };
    let last = app.announce(last).await;
    let tour = app.tour(&last).await;
    app.complete(&tour).await;
}

/// A request that was acknowledged and is not there.
#[tokio::test]
#[should_panic(expected = "lost: ")]
async fn a_lost_request_is_noticed() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let mut station = Station::new("station", 1, Duration::from_millis(1));
    let nowhere = "0190163d-8694-739b-8ca7-c9f6e6a7b0a1".to_owned();
    station.acknowledged.push((crate::field::request("s1"), nowhere));
    verify::acknowledged(&app, &[station], &[]).await;
}

/// A request that is planned without a tour.
#[tokio::test]
#[should_panic(expected = "a planned request that is no stop")]
async fn a_broken_rule_is_noticed() {
    let mut app = TestApp::start().await;
    app.put(line(1)).await;
    app.ask("s1").await;
    app.kill9();
    let mut conn = crate::database::open_copy(&app.database()).await;
    sqlx::query("UPDATE requests SET state = 'planned'").execute(&mut conn).await.unwrap();
    rules::hold(&app.database()).await;
}

/// Sensors on a spiral, and a capacity that leaves most of a batch for the next departure.
pub fn network() -> NetworkSpec {
    let mut spec = line(SENSORS);
    for (i, sensor) in spec.sensors.iter_mut().enumerate() {
        let (angle, radius) = (i as f64 * 2.399963, 20.0 + 3.0 * i as f64);
        sensor.place = at_rest(radius * angle.cos(), radius * angle.sin());
    }
    spec.charger_types[0].capacity_j = Some(2500.0);
    spec
}
