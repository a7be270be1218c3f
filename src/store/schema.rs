//! The schema: bringing a database up to the present version, and telling whose database a file is.

use sqlx::SqliteConnection;
use sqlx::migrate::Migrator;

use super::StoreError;

static MIGRATOR: Migrator = sqlx::migrate!("migrations/sqlite");

/// The version that this program makes.
pub(super) fn present() -> i64 {
    MIGRATOR.iter().map(|migration| migration.version).max().unwrap_or_default()
}

/// The version of a database: 0 of an empty one.
///
/// # Errors
/// It is not voltour's, or of a later version than this program knows.
pub(super) async fn version(conn: &mut SqliteConnection) -> Result<i64, StoreError> {
    let tables = "SELECT count(*), count(*) FILTER (WHERE name = '_sqlx_migrations') \
                  FROM sqlite_schema WHERE type = 'table'";
    let (tables, history): (i64, i64) = sqlx::query_as(tables).fetch_one(&mut *conn).await?;
    if tables == 0 {
        return Ok(0);
    }
    if history == 0 {
        return Err(StoreError::Foreign);
    }
    let found = "SELECT coalesce(max(version), 0) FROM _sqlx_migrations";
    let found: i64 = sqlx::query_scalar(found).fetch_one(conn).await?;
    let known = present();
    if found > known { Err(StoreError::Newer { found, known }) } else { Ok(found) }
}

/// Brings a database up to the present version.
pub(super) async fn bring_up(conn: &mut SqliteConnection) -> Result<(), StoreError> {
    version(conn).await?;
    Ok(MIGRATOR.run(conn).await?)
}
