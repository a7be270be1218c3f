//! The service as it is used, for a long time, and killed again and again.
//!
//! The story: four base stations stream requests, two chargers depart, report and complete one tour after the
//! other, an operator pages through the history, and every other life of the process the network is another one.
//! About once a minute the process is killed and starts again on the same database. After each life everything
//! that was acknowledged must be there, the rules of "planned once" must hold, `voltour check` must have passed every
//! plan of the history, and the memory must not have grown. It ends after a time that is given.
//!
//! `VOLTOUR_SOAK_S`, `VOLTOUR_SOAK_KILL_S` and `VOLTOUR_SOAK_SEED` say how long, how long a life is, and which (`just soak`).

mod history;
mod memory;
mod operator;
mod tests;

use std::sync::Arc;
use std::time::{Duration, Instant};

use voltour::proto::{NetworkSpec, Objective};

use crate::app::{Settings, TestApp};
use crate::crash::aim::Killed;
use crate::crash::charger::Charger;
use crate::crash::rng::Rng;
use crate::crash::station::Station;
use crate::crash::{self, number, rules, verify};
use crate::field::covered;
use crate::time::pause;
use history::History;
use memory::Memory;
use operator::Operator;

/// Between two requests of a base station.
const PACE: Duration = Duration::from_millis(50);
/// Lives of one run at most, whatever it was told.
const LIVES: u64 = 1_000;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "takes minutes: `just soak`"]
async fn soak() {
    let seed = number("VOLTOUR_SOAK_SEED", 1);
    let length = Duration::from_secs(number("VOLTOUR_SOAK_S", 120));
    let kill_s = number("VOLTOUR_SOAK_KILL_S", 60);
    let mut soak = Soak::begin(seed).await;
    let end = Instant::now() + length;
    while Instant::now() < end && soak.lives < LIVES {
        soak.live(Duration::from_secs(kill_s).min(end - Instant::now())).await;
    }
    soak.finish().await;
}

/// The service and everybody who uses it.
struct Soak {
    app: TestApp,
    rng: Rng,
    stations: Vec<Station>,
    chargers: Vec<Charger>,
    operator: Operator,
    memory: Memory,
    lives: u64,
}

impl Soak {
    async fn begin(seed: u64) -> Self {
        let settings = Settings { budget: "500ms", lead: "1500ms", ..Settings::default() };
        let app = TestApp::with(settings).await;
        let names = ["north", "east", "south", "west"];
        let station = |(i, name)| Station::new(name, seed.wrapping_mul(10) + i, PACE);
        Self {
            rng: Rng::new(seed),
            stations: (0..).zip(names).map(station).collect(),
            chargers: ["A", "B"].map(|id| Charger::new(id, seed)).into(),
            operator: Operator::new(app.file("checked")),
            memory: Memory::default(),
            lives: 0,
            app,
        }
    }

    /// Everybody works for a while, then the process is killed; the next one is asked what it knows.
    async fn live(&mut self, about: Duration) {
        self.app
            .put(if self.lives.is_multiple_of(2) { crash::network() } else { coverage() })
            .await;
        let killed = Arc::new(Killed::default());
        let stations = self.stations.drain(..).map(|mut station| {
            let (requests, killed) = (self.app.requests(), killed.clone());
            tokio::spawn(async move {
                station.pour(requests, &killed).await;
                station
            })
        });
        let stations: Vec<_> = stations.collect();
        let chargers = self.chargers.drain(..).map(|mut charger| {
            let (departures, tours) = (self.app.departures(), self.app.tours());
            let killed = killed.clone();
            tokio::spawn(async move {
                charger.drive(departures, tours, &killed).await;
                charger
            })
        });
        let chargers: Vec<_> = chargers.collect();
        let (history, pid) = (History::of(&self.app.rest), self.app.pid());
        let around = async {
            // From three quarters of it to the whole.
            let most = u64::try_from(about.as_millis()).expect("a length that fits").max(4);
            pause(self.rng.range(most * 3 / 4, most)).await;
            killed.strike();
            self.app.kill9();
        };
        tokio::join!(
            self.operator.read(&history, &killed),
            self.memory.sample(pid, &killed),
            around
        );
        for station in stations {
            self.stations.push(station.await.expect("a base station's story"));
        }
        for charger in chargers {
            self.chargers.push(charger.await.expect("a charger's story"));
        }
        self.lives += 1;
        self.app.launch().await;
        self.verify().await;
        println!("life {}: {}", self.lives, self.memory.last());
    }

    async fn verify(&mut self) {
        verify::acknowledged(&self.app, &self.stations, &self.chargers).await;
        rules::hold(&self.app.database()).await;
        let history = History::of(&self.app.rest);
        self.operator.catch_up(&history).await.expect("the history");
    }

    /// Everybody finishes what he is at, and nothing may be left in between.
    async fn finish(mut self) {
        crash::settle(&self.app, &mut self.stations, &mut self.chargers).await;
        self.verify().await;
        rules::settled(&self.app.database()).await;
        for tour in self.chargers.iter().flat_map(|charger| charger.tours.values()) {
            self.operator.knows(&tour.plan_id, &tour.departure_id);
        }
        let acknowledged: usize = self.stations.iter().map(|s| s.acknowledged.len()).sum();
        let departures: usize = self.chargers.iter().map(|c| c.announced.len()).sum();
        let visits: usize = self.chargers.iter().map(|c| c.visits.len()).sum();
        println!(
            "{} lives, {acknowledged} requests acknowledged, {departures} departures, {visits} visits; {}; {}",
            self.lives, self.operator, self.memory
        );
        self.memory.is_flat();
    }
}

/// The same sensors under a coverage constraint.
fn coverage() -> NetworkSpec {
    let mut spec = crash::network();
    spec.objective = Objective::MinDistance as i32;
    spec.coverage = covered(1, 3).coverage;
    for sensor in &mut spec.sensors {
        sensor.range_m = Some(90.0);
    }
    spec
}
