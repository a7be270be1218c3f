//! Retention: deletes what has been over for long, a little at a time, so that nobody waits for it. What is open,
//! batched or planned, and whatever a departure or a tour needs that is not over, is never touched. The call that made
//! what is deleted is remembered for a while: repeated, it makes nothing anew.

use std::time::Duration;

use jiff::Timestamp;
use serde::Serialize;
use sqlx::sqlite::SqliteRow;

use super::announce::ANNOUNCE;
use super::remembered::Remembered;
use super::submit::SUBMIT;
use crate::clock::minus;
use crate::domain::{ClientId, Fingerprint, NetworkId};
use crate::store::StoreError;
use crate::store::cells::Cells;
use crate::store::rows::{self, departure_columns, request_columns};
use crate::store::writer::{Command, Failure, Writing};

/// Departures, requests and calls deleted at once, each.
pub const PORTION: i64 = 100;
/// Client ids are remembered so much longer than what they made.
const LONGER: Duration = Duration::from_secs(7 * 86_400);

/// Deletes a portion of what ended before a time.
#[derive(Clone, Copy, Debug)]
pub struct Forget {
    /// What ended after it is kept.
    pub before: Timestamp,
}

/// How much was deleted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Forgotten {
    /// Departures, with their plans, tours, visits and explanations.
    pub departures: u64,
    /// Requests.
    pub requests: u64,
    /// Client ids of calls.
    pub calls: u64,
}

impl Forgotten {
    /// Whether there may be more to delete.
    pub fn is_whole_portion(self) -> bool {
        let Self { departures, requests, calls } = self;
        [departures, requests, calls].iter().any(|number| *number >= PORTION.unsigned_abs())
    }
}

impl std::ops::AddAssign for Forgotten {
    fn add_assign(&mut self, more: Self) {
        self.departures += more.departures;
        self.requests += more.requests;
        self.calls += more.calls;
    }
}

/// Departures that are over, and have no tour out. The last change of a network's departures and tours stays: the
/// numbers of changes go on from it.
const DEPARTURES: &str = "\
    SELECT d.id FROM departures d WHERE d.state IN ('completed', 'overdue', 'cancelled', 'missed') \
    AND d.updated_us < ?1 AND d.change < (SELECT max(change) FROM departures WHERE network_id = d.network_id) \
    AND NOT EXISTS (SELECT 1 FROM tours t WHERE t.departure_id = d.id AND (t.state = 'out' OR t.updated_us >= ?1 \
    OR t.change = (SELECT max(change) FROM tours WHERE network_id = d.network_id))) \
    ORDER BY d.updated_us LIMIT ?2";

/// Requests that are over, that no tour which is kept has as a stop, and of which no sensor is taken for dead.
const REQUESTS: &str = "\
    SELECT r.id FROM requests r WHERE r.state IN ('served', 'expired', 'withdrawn', 'superseded') \
    AND r.updated_us < ?1 AND r.change < (SELECT max(change) FROM requests WHERE network_id = r.network_id) \
    AND NOT EXISTS (SELECT 1 FROM stops s WHERE s.request_id = r.id) \
    AND NOT EXISTS (SELECT 1 FROM dead_sensors d WHERE d.network_id = r.network_id AND d.request_id = r.id) \
    ORDER BY r.updated_us LIMIT ?2";

/// Calls whose work is gone: an ended tour or departure, a request, trajectories that later ones have replaced. Those
/// that made a request or a departure are here from its deletion on.
/// What a `put` has made, a version of a network, is kept for good, and so is its id.
const CALLS: &str = "\
    SELECT c.rowid FROM calls c WHERE c.created_us < ?1 AND CASE substr(c.scope, 1, instr(c.scope, ':')) \
    WHEN 'complete:' THEN NOT EXISTS (SELECT 1 FROM tours WHERE id = substr(c.scope, 10)) \
    WHEN 'cancel:' THEN NOT EXISTS (SELECT 1 FROM departures WHERE id = substr(c.scope, 8)) \
    WHEN 'withdraw:' THEN NOT EXISTS (SELECT 1 FROM requests WHERE id = json_extract(c.answer, '$')) \
    WHEN 'trajectories:' THEN NOT EXISTS (SELECT 1 FROM trajectories t \
    WHERE t.network_id = substr(c.scope, 14) AND t.updated_us = c.created_us) \
    WHEN 'submit:' THEN 1 WHEN 'announce:' THEN 1 ELSE 0 END ORDER BY c.created_us LIMIT ?2";

/// What is remembered of the departures that go.
const ANNOUNCED: &str = concat!(
    "SELECT d.network_id, d.fingerprint, ",
    departure_columns!(),
    " FROM departures d WHERE d.id IN (SELECT id FROM going)"
);

/// What is remembered of the requests that go.
const SUBMITTED: &str = concat!(
    "SELECT r.fingerprint, ",
    request_columns!(),
    " FROM requests r WHERE r.id IN (SELECT id FROM going)"
);

/// What hangs on departures, from the leaves to the root.
const OF_DEPARTURES: [&str; 6] = [
    "DELETE FROM explanations WHERE plan_id IN (SELECT id FROM plans WHERE departure_id IN (SELECT id FROM going))",
    "DELETE FROM visits WHERE tour_id IN (SELECT id FROM tours WHERE departure_id IN (SELECT id FROM going))",
    "DELETE FROM stops WHERE tour_id IN (SELECT id FROM tours WHERE departure_id IN (SELECT id FROM going))",
    "DELETE FROM tours WHERE departure_id IN (SELECT id FROM going)",
    "DELETE FROM plans WHERE departure_id IN (SELECT id FROM going)",
    "DELETE FROM departures WHERE id IN (SELECT id FROM going)",
];

impl Command for Forget {
    type Answer = Forgotten;

    async fn apply(&self, w: &mut Writing) -> Result<Forgotten, Failure> {
        let calls = minus(self.before, LONGER);
        choose(w, DEPARTURES, self.before).await?;
        self.remember(w, ANNOUNCE, ANNOUNCED, rows::departure).await?;
        let mut departures = 0;
        for sql in OF_DEPARTURES {
            departures = sqlx::query(sql).execute(&mut w.conn).await?.rows_affected();
        }
        choose(w, REQUESTS, self.before).await?;
        self.remember(w, SUBMIT, SUBMITTED, rows::request).await?;
        let requests = delete(w, "DELETE FROM requests WHERE id IN (SELECT id FROM going)").await?;
        choose(w, CALLS, calls).await?;
        let calls = delete(w, "DELETE FROM calls WHERE rowid IN (SELECT id FROM going)").await?;
        Ok(Forgotten { departures, requests, calls })
    }
}

impl Forget {
    /// Remembers the calls that made the rows that are to go.
    async fn remember<T: Serialize>(
        &self,
        w: &mut Writing,
        call: &'static str,
        sql: &'static str,
        read: fn(&SqliteRow) -> Result<T, StoreError>,
    ) -> Result<(), StoreError> {
        for row in sqlx::query(sql).fetch_all(&mut w.conn).await? {
            let cells = Cells::new(call, &row);
            let (network, client_id): (NetworkId, ClientId) =
                (cells.parsed("network_id")?, cells.parsed("client_id")?);
            let fingerprint: &[u8] = cells.get("fingerprint")?;
            let fingerprint =
                fingerprint.try_into().map_err(|error| StoreError::row(call, error))?;
            let call = Remembered::with(call, network, &client_id, Fingerprint(fingerprint));
            call.keep_since(self.before, w, &read(&row)?).await?;
        }
        Ok(())
    }
}

/// Puts what is to go into a table of the connection's own.
async fn choose(w: &mut Writing, sql: &'static str, before: Timestamp) -> Result<(), StoreError> {
    for sql in ["CREATE TEMP TABLE IF NOT EXISTS going (id PRIMARY KEY)", "DELETE FROM going"] {
        sqlx::query(sql).execute(&mut w.conn).await?;
    }
    let insert = sqlx::AssertSqlSafe(format!("INSERT INTO going {sql}"));
    sqlx::query(insert).bind(before.as_microsecond()).bind(PORTION).execute(&mut w.conn).await?;
    Ok(())
}

async fn delete(w: &mut Writing, sql: &'static str) -> Result<u64, StoreError> {
    Ok(sqlx::query(sql).execute(&mut w.conn).await?.rows_affected())
}
