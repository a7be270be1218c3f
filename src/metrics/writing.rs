//! What the writer does to the database. The store makes these, for it is there before anything else.

use std::sync::atomic::AtomicU64;

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};

use super::labels::{StateLabels, SubmissionLabels};
use super::{Level, SUBMITTED, TIMES_S};

/// Commands in a transaction.
const COMMANDS: [f64; 10] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1_000.0];
/// How departures end.
const ENDS: [&str; 4] = ["completed", "overdue", "cancelled", "missed"];

/// Clones count together.
#[derive(Clone, Debug)]
pub struct WriterMetrics {
    batch: Histogram,
    time: Histogram,
    failures: Counter,
    reopenings: Counter,
    last_commit_s: Gauge<f64, AtomicU64>,
    writable: Gauge,
    /// Commands that wait for the writer, or are in its transaction.
    pub commands: Level,
    pub(super) submissions: Family<SubmissionLabels, Counter>,
    ended: Family<StateLabels, Counter>,
}

impl Default for WriterMetrics {
    fn default() -> Self {
        let counted = Self {
            batch: Histogram::new(COMMANDS),
            time: Histogram::new(TIMES_S),
            failures: Counter::default(),
            reopenings: Counter::default(),
            last_commit_s: Gauge::default(),
            writable: Gauge::default(),
            commands: Level::default(),
            submissions: Family::default(),
            ended: Family::default(),
        };
        counted.writable.set(1);
        for outcome in SUBMITTED {
            counted.submissions.get_or_create_owned(&SubmissionLabels { outcome });
        }
        for state in ENDS {
            counted.ended.get_or_create_owned(&StateLabels { state });
        }
        counted
    }
}

impl WriterMetrics {
    pub(super) fn register(&self, registry: &mut Registry) {
        let unit = || Unit::Other("commands".to_owned());
        let help = "In one transaction";
        registry.register_with_unit("commit_batch", help, unit(), self.batch.clone());
        let help = "Time of a transaction, from its beginning to the end of its commit";
        registry.register_with_unit("commit_time", help, Unit::Seconds, self.time.clone());
        let help = "Transactions of which the database did not say that they were committed";
        registry.register("commit_failures", help, self.failures.clone());
        let help = "When the last transaction was committed, in Unix time; 0 before the first";
        let last = self.last_commit_s.clone();
        registry.register_with_unit("last_commit_timestamp", help, Unit::Seconds, last);
        let help = "Databases opened again after a failed transaction";
        registry.register("database_reopenings", help, self.reopenings.clone());
        let help = "1 while the database can be written, 0 from a failed transaction until it is open again";
        registry.register("database_writable", help, self.writable.clone());
        let help = "That wait for the writer, or are in its transaction";
        registry.register_with_unit("writer_queue", help, unit(), self.commands.0.clone());
        let help = "Charging requests submitted, each item of a stream, by what became of it";
        registry.register("submissions", help, self.submissions.clone());
        let help = "Departures that came to their end";
        registry.register("departures_ended", help, self.ended.clone());
    }

    /// A transaction of so many commands is committed, at this Unix time.
    pub fn committed(&self, commands: usize, took_s: f64, at_s: f64) {
        self.batch.observe(u32::try_from(commands).map_or(f64::MAX, f64::from));
        self.time.observe(took_s);
        self.last_commit_s.set(at_s);
    }

    /// The database failed: nothing is written until it is open again.
    pub fn failed(&self) {
        self.failures.inc();
        self.writable.set(0);
    }

    /// The database is open again.
    pub fn reopened(&self) {
        self.reopenings.inc();
        self.writable.set(1);
    }

    /// Requests were stored, and such that had been before were answered again.
    pub fn submitted(&self, accepted: u64, duplicates: u64) {
        let count = |outcome, by| {
            self.submissions.get_or_create_owned(&SubmissionLabels { outcome }).inc_by(by);
        };
        count("accepted", accepted);
        count("duplicate", duplicates);
    }

    /// A departure ended in this state.
    pub fn ended(&self, state: &'static str) {
        self.ended.get_or_create_owned(&StateLabels { state }).inc();
    }
}
