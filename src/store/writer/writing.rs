//! What a command has at hand while it is applied: the connection within the transaction, the time,
//! the numbers to give out, and what is known without asking.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use sqlx::{Connection, SqliteConnection};
use uuid::Uuid;

use super::tally::Tally;
use crate::clock::{Clock, Ids};
use crate::store::cells::signed;
use crate::store::networks::Networks;

/// The inside of a transaction.
pub(crate) struct Writing {
    /// The connection that writes.
    pub conn: SqliteConnection,
    /// When the transaction began.
    pub now: Timestamp,
    /// What is known of networks without asking the database.
    pub(in crate::store) networks: Networks,
    /// Whether a departure or a tour was changed.
    pub tours_moved: bool,
    /// What is counted once it is committed.
    pub(in crate::store) tally: Tally,
    clock: Arc<dyn Clock>,
    /// What the clock had run then.
    began: Duration,
    ids: Ids,
    change: u64,
}

impl Writing {
    pub fn new(conn: SqliteConnection, change: u64, clock: Arc<dyn Clock>, ids: Ids) -> Self {
        let (now, began) = (clock.now(), clock.ran());
        let (networks, tally) = (Networks::default(), Tally::default());
        Self { conn, now, networks, tours_moved: false, tally, clock, began, ids, change }
    }

    /// Closes the connection, whatever its state; what remains goes to the next one.
    pub async fn closed(self) -> (Arc<dyn Clock>, Ids) {
        // It is closed because it failed; how it ends is of no interest.
        let _ = self.conn.close().await;
        (self.clock, self.ids)
    }

    /// A new id.
    pub fn id(&self) -> Uuid {
        self.ids.next(self.now)
    }

    /// The number of the next row that changes; the caller takes it once it has.
    pub fn coming_change(&self) -> i64 {
        self.changes_before() + 1
    }

    /// The number before: for a statement that changes many rows and counts them itself.
    pub fn changes_before(&self) -> i64 {
        signed(self.change)
    }

    /// Takes as many numbers as rows were changed: each number stands in a row.
    pub fn took_changes(&mut self, rows: u64) {
        self.change += rows;
    }

    /// The present moment in microseconds.
    pub fn now_us(&self) -> i64 {
        self.now.as_microsecond()
    }

    /// The number of the last change given out.
    pub fn change(&self) -> u64 {
        self.change
    }

    /// The moment by the clock, which goes on while a transaction runs.
    pub fn clock_now(&self) -> Timestamp {
        self.clock.now()
    }

    /// How long the transaction has run.
    pub fn ran(&self) -> Duration {
        self.clock.ran().saturating_sub(self.began)
    }

    /// Begins: reads the clock.
    pub fn begun(&mut self) {
        (self.now, self.began) = (self.clock.now(), self.clock.ran());
        self.tours_moved = false;
        self.tally = Tally::default();
    }

    /// Forgets what a transaction did that was rolled back.
    pub fn rolled_back(&mut self, change: u64) {
        self.change = change;
        self.networks.forget();
        self.tours_moved = false;
        self.tally = Tally::default();
    }
}
