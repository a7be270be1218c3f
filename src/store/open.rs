//! Opening the database: the lock, the schema, the connections; and opening it again after a failed
//! write.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqlitePoolOptions, SqliteSynchronous};
use sqlx::{ConnectOptions, Connection, SqliteConnection};
use tokio::sync::watch;

use super::lock::Lock;
use super::writer::{self, Writer};
use super::{Reads, StoreError, Trouble, schema};
use crate::clock::{Clock, Ids};

/// Connections that read at once.
const READERS: u32 = 8;
/// How long a reader waits for a connection.
const PATIENCE: Duration = Duration::from_secs(10);

/// An open database: one writer, many readers.
#[derive(Debug)]
pub struct Store {
    /// Its read half.
    pub reads: Reads,
    /// Its write half.
    pub writer: Writer,
    pub(crate) task: writer::Task,
}

impl Store {
    /// Opens the database, makes it where there is none, and brings its schema up to date.
    ///
    /// # Errors
    /// Another process has it open, or it cannot be opened, migrated or verified.
    pub async fn open(path: &Path, clock: Arc<dyn Clock>) -> Result<Self, StoreError> {
        let database = Database { lock: Lock::take(path)? };
        let path = &database.path().to_owned();
        let (mut conn, change) = database.open().await.map_err(|error| damaged(path, error))?;
        let pool = SqlitePoolOptions::new().max_connections(READERS).acquire_timeout(PATIENCE);
        let (tell, trouble) = watch::channel(None);
        let reads = Reads::new(pool.connect_with(options(path).read_only(true)).await?, trouble);
        let ids = last_id(&mut conn).await?;
        let (writer, task) = writer::spawn(database, conn, change, clock, reads.clone(), tell, ids);
        Ok(Self { reads, writer, task })
    }

    /// Ends a store that nothing was started on.
    ///
    /// # Errors
    /// The last checkpoint failed.
    pub(crate) async fn close(self) -> Result<(), StoreError> {
        self.task.stop.cancel();
        self.task.ended.await.unwrap_or_else(|error| Err(StoreError::Task(error.to_string())))
    }
}

/// A connection that writes.
pub(super) async fn connect(path: &Path, create: bool) -> Result<SqliteConnection, StoreError> {
    Ok(options(path).create_if_missing(create).connect().await?)
}

fn options(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new()
        .filename(path)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .busy_timeout(Duration::from_secs(5))
        .disable_statement_logging()
}

/// The database file, locked.
#[derive(Debug)]
pub(super) struct Database {
    lock: Lock,
}

impl Database {
    fn path(&self) -> &Path {
        self.lock.database()
    }

    /// The connection that writes, and the last change. All of the database is looked at first: what is
    /// damaged must not be built upon.
    pub async fn open(&self) -> Result<(SqliteConnection, u64), StoreError> {
        if self.path().exists() {
            check(self.path()).await?;
        }
        let mut conn = connect(self.path(), true).await?;
        schema::bring_up(&mut conn).await?;
        let change = last_change(&mut conn).await?;
        Ok((conn, change))
    }

    /// Opens the database again after a failed write. What was acknowledged must be there: a last
    /// change before `acknowledged` is a database that has lost something. Unless it `is_whole` already, all of
    /// it is looked at, and then it is.
    pub async fn reopen(
        &self,
        acknowledged: u64,
        is_whole: &mut bool,
    ) -> Result<(SqliteConnection, u64), StoreError> {
        if !*is_whole {
            check(self.path()).await?;
            *is_whole = true;
        }
        let mut conn = connect(self.path(), false).await?;
        let change = last_change(&mut conn).await?;
        if change < acknowledged {
            let reason = format!("the last change is {change}, {acknowledged} was acknowledged");
            return Err(StoreError::Verification(reason));
        }
        // What the failed transaction wrote may have been kept all the same, unacknowledged. Writing
        // it back into the file before anything else shows that syncing works again.
        let checkpoint = "PRAGMA wal_checkpoint(TRUNCATE)";
        let (busy, _, _): (i64, i64, i64) = sqlx::query_as(checkpoint).fetch_one(&mut conn).await?;
        if busy != 0 {
            return Err(StoreError::Troubled(Trouble::Locked));
        }
        // A transaction of one page, synced, which changes nothing: there is room, and nobody holds a lock.
        sqlx::query("PRAGMA user_version = 0").execute(&mut conn).await?;
        Ok((conn, change))
    }
}

/// Looks at every page, on a connection that is closed again: what it has read is not to be believed later.
async fn check(path: &Path) -> Result<(), StoreError> {
    let mut conn = connect(path, false).await?;
    let verdict = sqlx::query_scalar("PRAGMA quick_check(1)").fetch_one(&mut conn).await;
    conn.close().await?;
    let verdict: String = verdict?;
    if verdict == "ok" { Ok(()) } else { Err(StoreError::Verification(verdict)) }
}

/// Says so of an error that damage is behind.
fn damaged(path: &Path, error: StoreError) -> StoreError {
    match Trouble::of(&error) {
        Some(Trouble::Damaged) => StoreError::damaged(path, error),
        _ => error,
    }
}

/// Checkpoints and closes.
pub(super) async fn close(mut conn: SqliteConnection) -> Result<(), StoreError> {
    sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)").execute(&mut conn).await?;
    Ok(conn.close().await?)
}

/// Goes on after the ids that the service made before, also where the clock was set back since.
async fn last_id(conn: &mut SqliteConnection) -> Result<Ids, StoreError> {
    let ids = Ids::default();
    for sql in [
        "SELECT max(id) FROM requests",
        "SELECT max(id) FROM departures",
        "SELECT max(id) FROM plans",
        "SELECT max(id) FROM tours",
        "SELECT max(id) FROM visits",
    ] {
        let last: Option<String> = sqlx::query_scalar(sql).fetch_one(&mut *conn).await?;
        if let Some(last) = last.and_then(|last| last.parse().ok()) {
            ids.go_on_after(last);
        }
    }
    Ok(ids)
}

async fn last_change(conn: &mut SqliteConnection) -> Result<u64, StoreError> {
    let mut last = 0;
    // By network, for that is what the indices begin with.
    for sql in [
        "SELECT max((SELECT max(change) FROM requests WHERE network_id = n.id)) FROM networks n",
        "SELECT max((SELECT max(change) FROM departures WHERE network_id = n.id)) FROM networks n",
        "SELECT max((SELECT max(change) FROM tours WHERE network_id = n.id)) FROM networks n",
    ] {
        let change: Option<i64> = sqlx::query_scalar(sql).fetch_one(&mut *conn).await?;
        last = last.max(change.unwrap_or_default().unsigned_abs());
    }
    Ok(last)
}
