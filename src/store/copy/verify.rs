//! Whether a file is a whole database of voltour: every page and index, every reference, the schema.

use std::path::Path;

use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Connection, SqliteConnection};

use crate::store::{StoreError, schema};

/// What a copy was found to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verified {
    /// Its length.
    pub bytes: u64,
    /// The version of its schema.
    pub schema: i64,
    /// Requests in it.
    pub requests: i64,
    /// Plans in it.
    pub plans: i64,
}

/// Reads all of a database that nobody writes.
///
/// # Errors
/// It is damaged, not voltour's, or of a later version than this program knows.
pub(super) async fn verify(file: &Path) -> Result<Verified, StoreError> {
    // Nobody writes it, so that no log and no lock have to be made beside it.
    let options = SqliteConnectOptions::new().filename(file).immutable(true).read_only(true);
    let mut conn = options.disable_statement_logging().connect().await?;
    let verified = whole(&mut conn, file).await;
    conn.close().await?;
    verified
}

async fn whole(conn: &mut SqliteConnection, file: &Path) -> Result<Verified, StoreError> {
    let schema = schema::version(conn).await?;
    if schema == 0 {
        return Err(StoreError::Foreign);
    }
    let verdict = "PRAGMA integrity_check(1)";
    let verdict: String = sqlx::query_scalar(verdict).fetch_one(&mut *conn).await?;
    if verdict != "ok" {
        return Err(StoreError::damaged(file, verdict));
    }
    let orphan = "SELECT \"table\" FROM pragma_foreign_key_check LIMIT 1";
    let orphan: Option<String> = sqlx::query_scalar(orphan).fetch_optional(&mut *conn).await?;
    if let Some(table) = orphan {
        let reason = format!("a row of {table} refers to one that is not there");
        return Err(StoreError::damaged(file, reason));
    }
    let counts = "SELECT (SELECT count(*) FROM requests), (SELECT count(*) FROM plans)";
    let (requests, plans) = sqlx::query_as(counts).fetch_one(conn).await?;
    let bytes = file.metadata().map_err(|source| StoreError::file(file, source))?.len();
    Ok(Verified { bytes, schema, requests, plans })
}
