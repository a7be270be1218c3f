//! What is not counted but looked up, when a monitor asks: the census of the database.

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::{Registry, Unit};

use super::labels::{FileLabels, StateLabels};
use crate::store::Census;

/// As it was looked up last; clones tell the same.
#[derive(Clone, Debug, Default)]
pub(super) struct LookedUp {
    departures: Family<StateLabels, Gauge>,
    open_requests: Gauge,
    unexplained: Gauge,
    size: Family<FileLabels, Gauge>,
    failures: Counter,
}

impl LookedUp {
    pub fn register(registry: &mut Registry) -> Self {
        let seen = Self::default();
        let help = "Departures that are not over";
        registry.register("departures", help, seen.departures.clone());
        let help = "Charging requests that are open";
        registry.register("open_requests", help, seen.open_requests.clone());
        let unit = Unit::Other("plans".to_owned());
        let help = "That are still to be explained, among the newest";
        registry.register_with_unit("unexplained", help, unit, seen.unexplained.clone());
        let help = "The database and its log";
        registry.register_with_unit("database_size", help, Unit::Bytes, seen.size.clone());
        let help = "Times that the database could not be looked at for a monitor, whose gauges are old then";
        registry.register("census_failures", help, seen.failures.clone());
        seen
    }

    pub fn see(&self, census: &Census) {
        let count = |n: u64| i64::try_from(n).unwrap_or(i64::MAX);
        for (state, n) in [
            ("announced", census.announced),
            ("closed", census.closed),
            ("planned", census.planned),
        ] {
            self.departures.get_or_create_owned(&StateLabels { state }).set(count(n));
        }
        self.open_requests.set(count(census.open_requests));
        self.unexplained.set(count(census.unexplained));
        for (file, bytes) in [("database", census.database_bytes), ("log", census.log_bytes)] {
            self.size.get_or_create_owned(&FileLabels { file }).set(count(bytes));
        }
    }

    pub fn failed(&self) {
        self.failures.inc();
    }
}
